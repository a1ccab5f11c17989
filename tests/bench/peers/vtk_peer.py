"""Renders one dumped scene with a VTK volume mapper and times it. Started by compare.py, one process a configuration.

Input: the folder that `peers_driver dump` wrote (scene.json, voxels.raw). Output: RGBA float32 rows from the top in
--out, and one line of JSON on stdout with the CPU seconds (all threads of this process, read-back included) of each
frame after the warm-up.
"""
import argparse
import json
import math
import pathlib
import sys
import time

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def image_data(folder, meta, data_type):
    voxels = numpy.fromfile(folder / "voxels.raw", dtype=numpy.float32)
    if data_type == "u8":
        lo, hi = meta["transfer"]["lo"], meta["transfer"]["hi"]
        voxels = numpy.clip(numpy.rint((voxels - lo) / (hi - lo) * 255), 0, 255).astype(numpy.uint8)
    image = vtk.vtkImageData()
    image.SetDimensions(meta["size"])
    image.SetSpacing(meta["spacing"])
    image.SetOrigin(meta["origin"])
    image.GetPointData().SetScalars(numpy_to_vtk(voxels, deep=True))
    return image


def volume_property(meta, data_type):
    """The scene's extinction is piecewise linear; VTK interpolates opacities, so it gets them densely sampled."""
    lo, hi = meta["transfer"]["lo"], meta["transfer"]["hi"]
    points = meta["transfer"]["points"]
    unit = min(meta["spacing"])
    values = sorted({p["value"] for p in points} | {lo + (hi - lo) * i / 4096 for i in range(4097)})
    xs = [p["value"] for p in points]
    columns = {c: [p["colour"][i] for p in points] for i, c in enumerate("rgb")}
    tau = [p["extinction"] for p in points]
    to_data = (lambda v: (v - lo) / (hi - lo) * 255) if data_type == "u8" else (lambda v: v)
    opacity, colour = vtk.vtkPiecewiseFunction(), vtk.vtkColorTransferFunction()
    colour.SetColorSpaceToRGB()
    for v in values:
        opacity.AddPoint(to_data(v), -math.expm1(-float(numpy.interp(v, xs, tau)) * unit))
    for v in sorted(set(xs)):
        colour.AddRGBPoint(to_data(v), *(float(numpy.interp(v, xs, columns[c])) for c in "rgb"))
    prop = vtk.vtkVolumeProperty()
    prop.SetScalarOpacity(opacity)
    prop.SetColor(colour)
    prop.SetScalarOpacityUnitDistance(unit)
    prop.SetInterpolationTypeToLinear()
    prop.ShadeOff()
    return prop


def mapper_for(name, step):
    if name == "gpu":
        mapper = vtk.vtkGPUVolumeRayCastMapper()
        mapper.SetUseJittering(0)
    else:
        mapper = vtk.vtkFixedPointVolumeRayCastMapper()
        mapper.SetNumberOfThreads(1)
        mapper.SetImageSampleDistance(1)
        mapper.SetMinimumImageSampleDistance(1)
        mapper.SetMaximumImageSampleDistance(1)
    mapper.SetAutoAdjustSampleDistances(0)
    mapper.SetSampleDistance(step)
    return mapper


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mapper", choices=["gpu", "fixed_point"], required=True)
    parser.add_argument("--data", choices=["u8", "f32"], required=True)
    parser.add_argument("--step", type=float, required=True, help="voxels")
    parser.add_argument("--frames", type=int, default=5)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    args = parser.parse_args()
    vtk.vtkMultiThreader.SetGlobalMaximumNumberOfThreads(1)
    meta = json.loads((args.folder / "scene.json").read_text())
    view = meta["view"]

    mapper = mapper_for(args.mapper, args.step * min(meta["spacing"]))
    mapper.SetInputData(image_data(args.folder, meta, args.data))
    volume = vtk.vtkVolume()
    volume.SetMapper(mapper)
    volume.SetProperty(volume_property(meta, args.data))
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(0, 0, 0)
    renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(view["half_height"])
    camera.SetPosition(view["eye"])
    camera.SetFocalPoint(view["target"])
    camera.SetViewUp(view["up"])
    renderer.ResetCameraClippingRange()
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(meta["width"], meta["height"])
    window.AddRenderer(renderer)

    pixels = vtk.vtkUnsignedCharArray()
    seconds = []
    warm_up = 2
    for frame in range(warm_up + args.frames):
        start = time.process_time()
        camera.Modified()
        window.Render()
        window.GetPixelData(0, 0, meta["width"] - 1, meta["height"] - 1, 0, pixels, 0)
        if frame >= warm_up:
            seconds.append(time.process_time() - start)

    rgb = vtk_to_numpy(pixels).reshape(meta["height"], meta["width"], 3)[::-1].astype(numpy.float32) / 255
    rgba = numpy.ones((meta["height"], meta["width"], 4), numpy.float32)
    rgba[..., :3] = rgb
    rgba.tofile(args.out)
    version = vtk.vtkVersion.GetVTKVersion()
    capabilities = window.ReportCapabilities() if args.mapper == "gpu" else ""
    driver = [line.split(":", 1)[1].strip() for line in capabilities.splitlines() if "OpenGL renderer" in line]
    json.dump({"cpu_seconds": seconds, "version": version, "driver": driver[0] if driver else "software"}, sys.stdout)


if __name__ == "__main__":
    main()
