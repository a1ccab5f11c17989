#!/usr/bin/python3
"""Time and error of volumark and of VTK's volume mappers, on the same scene, view and transfer function, in one run.

compare.py --driver BUILD/tests/bench/peers/peers_driver [--scenes FILE_OR_NAME ...] [--rounds 3] [--out DIR]

Every configuration runs in a process of its own, on one core; rounds go through all of them in turn, so that a slow
minute hits all alike. Printed are the median CPU milliseconds a frame (read-back included, two frames of warm-up left
out), the root mean square error of RGB over black against volumark's reference, and how many times cheaper each
configuration is than the VTK row marked "baseline". All of it is in DIR/peers.json, the pictures in DIR.
"""
import argparse
import json
import os
import pathlib
import shutil
import statistics
import subprocess
import sys

import numpy

HERE = pathlib.Path(__file__).resolve().parent
TARGET_RMSE = 0.002
BASELINE = "VTK GPU mapper on llvmpipe, float, step 0.5"


def vtk(mapper, data, step):
    return ["vtk", "--mapper", mapper, "--data", data, "--step", str(step)]


def ours(method, backend, **settings):
    return ["volumark", method, backend, {name: str(value) for name, value in settings.items()}]


CONFIGURATIONS = {
    "VTK fixed-point mapper, step 1": vtk("fixed_point", "u8", 1),
    "VTK fixed-point mapper, step 0.5": vtk("fixed_point", "u8", 0.5),
    "VTK GPU mapper on llvmpipe, u8, step 0.5": vtk("gpu", "u8", 0.5),
    "VTK GPU mapper on llvmpipe, float, step 1": vtk("gpu", "f32", 1),
    BASELINE: vtk("gpu", "f32", 0.5),
    "VTK GPU mapper on llvmpipe, float, step 0.25": vtk("gpu", "f32", 0.25),
    "raycast cpu, step 2": ours("raycast", "cpu", step=2),
    "raycast cpu, step 1": ours("raycast", "cpu", step=1),
    "raycast cpu, step 0.5": ours("raycast", "cpu", step=0.5),
    "raycast cpu, step 0.45": ours("raycast", "cpu", step=0.45),
    "raycast cpu, step 0.25": ours("raycast", "cpu", step=0.25),
    "raycast cpu, pre-integrated, step 1": ours("raycast", "cpu", step=1, classification="preintegrated",
                                                preintegrated_size=511),
    "raycast cpu, pre-integrated, step 0.75": ours("raycast", "cpu", step=0.75, classification="preintegrated",
                                                   preintegrated_size=511),
    "raycast cpu, pre-integrated, step 0.5": ours("raycast", "cpu", step=0.5, classification="preintegrated",
                                                  preintegrated_size=511),
    "raycast cpu, step 0.5, nothing skipped": ours("raycast", "cpu", step=0.5, skip_empty="none"),
    "raycast gl (llvmpipe), step 0.5": ours("raycast", "gl", step=0.5),
}


def command(configuration, driver, scene, dump, frames, out):
    if configuration[0] == "vtk":
        return [sys.executable, str(HERE / "vtk_peer.py"), str(dump), *configuration[1:], "--frames", str(frames),
                "--out", str(out)]
    _, method, backend, settings = configuration
    return [str(driver), "draw", scene, method, backend, str(frames), str(out),
            *(f"{name}={value}" for name, value in settings.items())]


def run(arguments, environment):
    """The JSON line that the process prints; None, with the reason on stderr, where it fails."""
    done = subprocess.run(arguments, env=environment, capture_output=True, text=True, check=False)
    lines = [line for line in done.stdout.splitlines() if line.startswith("{")]
    if done.returncode != 0 or not lines:
        print(f"failed: {' '.join(arguments)}\n{done.stderr.strip()}", file=sys.stderr)
        return None
    return json.loads(lines[-1])


def rmse(path, reference):
    image = numpy.fromfile(path, numpy.float32).reshape(-1, 4)[:, :3].astype(float)
    return float(numpy.sqrt(numpy.mean((image - reference) ** 2)))


def measure(scene, configurations, args, environment):
    name = pathlib.Path(scene).stem
    folder = args.out / name
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([str(args.driver), "dump", scene, str(folder)], check=True, env=environment)
    reference = numpy.fromfile(folder / "reference.raw", numpy.float32).reshape(-1, 4)[:, :3].astype(float)
    results = {label: {"cpu_seconds": []} for label in configurations}
    for _ in range(args.rounds):
        for number, (label, configuration) in enumerate(configurations.items()):
            out = folder / f"{number:02d}.raw"
            answer = run(command(configuration, args.driver, scene, folder, args.frames, out), environment)
            if answer is None:
                continue
            row = results[label]
            row["cpu_seconds"] += answer["cpu_seconds"]
            row["driver"] = answer["driver"]
            row["image"] = str(out.relative_to(args.out))
            row["rmse"] = rmse(out, reference)
    for row in results.values():
        row["median_ms"] = statistics.median(row["cpu_seconds"]) * 1e3 if row["cpu_seconds"] else None
    return results


def print_table(scene, results):
    baseline = results.get(BASELINE, {}).get("median_ms")
    print(f"\n{scene}")
    print(f"{'':46s} {'CPU ms':>8s} {'RMSE':>8s} {'cheaper than baseline':>22s}")
    for label, row in results.items():
        if row["median_ms"] is None:
            print(f"{label:46s} {'failed':>8s}")
            continue
        ratio = f"{baseline / row['median_ms']:.1f} x" if baseline else ""
        mark = "baseline" if label == BASELINE else ratio
        print(f"{label:46s} {row['median_ms']:8.1f} {row['rmse']:8.5f} {mark:>22s}")
    for program in ("VTK", "raycast"):
        near = [(row["median_ms"], label) for label, row in results.items()
                if label.startswith(program) and row["median_ms"] is not None and row["rmse"] <= TARGET_RMSE]
        answer = "{1}, {0:.1f} ms".format(*min(near)) if near else "none of these"
        print(f"  cheapest {program} at RMSE <= {TARGET_RMSE}: {answer}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--driver", type=pathlib.Path, required=True)
    parser.add_argument("--scenes", nargs="+", default=[str(HERE / "marschner_lobb.json"), str(HERE / "cloud.json")])
    parser.add_argument("--only", default="", help="configurations whose label contains this text, and the baseline")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--frames", type=int, default=5, help="of each configuration and round")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("out/peers"))
    args = parser.parse_args()
    if "DISPLAY" not in os.environ:
        if not shutil.which("xvfb-run"):
            sys.exit("no DISPLAY and no xvfb-run: apt install xvfb")
        os.execvp("xvfb-run", ["xvfb-run", "-a", sys.executable, *sys.argv])
    os.sched_setaffinity(0, {min(os.sched_getaffinity(0))})
    # One thread each: llvmpipe then draws on the calling thread.
    environment = {**os.environ, "LP_NUM_THREADS": "0", "MESA_SHADER_CACHE_DISABLE": "true",
                   "LIBGL_ALWAYS_SOFTWARE": "1"}
    chosen = {label: c for label, c in CONFIGURATIONS.items() if args.only in label or label == BASELINE}
    report = {}
    for scene in args.scenes:
        report[pathlib.Path(scene).stem] = results = measure(scene, chosen, args, environment)
        print_table(scene, results)
    (args.out / "peers.json").write_text(json.dumps(report, indent=1) + "\n")
    if any(row["median_ms"] is None for results in report.values() for row in results.values()):
        sys.exit(1)


if __name__ == "__main__":
    main()
