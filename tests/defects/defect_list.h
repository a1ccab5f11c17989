// What each planted error is, in a sentence, and where it is planted.
#pragma once

#include <array>

#include "backends/defects.h"

namespace volumark {

struct PlantedDefect {
  Defect kind;
  const char* name;
  const char* what;
  const char* method;  // "": of all
};

inline constexpr std::array kPlantedDefects = {
    PlantedDefect{Defect::LinearOpacity, "linear opacity", "opacity of a segment tau h instead of 1 - exp(-tau h)", ""},
    PlantedDefect{Defect::NaiveExponential, "naive exponential", "1 - exp(-x) by subtraction in float", ""},
    PlantedDefect{Defect::HalfVoxelShift, "half-voxel shift",
                  "texture coordinates without the half texel of the centres", "texture3d_slices"},
    PlantedDefect{Defect::MiscountedCells, "miscounted cells", "one cell too few along each axis", "raycast"},
    PlantedDefect{Defect::MissingFace, "missing face", "slabs are not clipped at two faces of the box",
                  "texture3d_slices"},
    PlantedDefect{Defect::MissingEdge, "missing edge", "one edge of the box is not sliced", "texture3d_slices"},
    PlantedDefect{Defect::UnguardedDivision, "unguarded division", "rays parallel to a face divide by zero", ""},
    PlantedDefect{Defect::FlippedParallel, "flipped comparison",
                  "the side of a clip plane that is parallel to the ray: >= for <, at zero", ""},
    PlantedDefect{Defect::RayLengthIgnored, "ray length ignored", "a step of depth is taken for a step along the ray",
                  ""},
    PlantedDefect{Defect::NearPlaneIgnored, "near plane ignored", "what lies behind the eye is drawn", "raycast"},
    PlantedDefect{Defect::LostSlice, "lost slice", "the middle slice is not drawn", "texture3d_slices"},
    PlantedDefect{Defect::DoubledEdge, "doubled edge", "the fill rule counts pixels on a shared edge twice",
                  "texture3d_slices"},
    PlantedDefect{Defect::DroppedLastSlab, "dropped last slab", "slabs rounded down", "texture3d_slices"},
    PlantedDefect{Defect::UnclippedLastSegment, "unclipped last segment",
                  "the last segment of a ray counts as a whole step", "raycast"},
    PlantedDefect{Defect::SwappedSlices, "swapped slices", "neighbouring slices blend in the wrong order",
                  "texture3d_slices"},
    PlantedDefect{Defect::TerminatesOnOpacity, "termination on opacity",
                  "a ray ends where its opacity, not its transmittance, is small", "raycast"},
    PlantedDefect{Defect::BricksMissNeighbours, "bricks miss neighbours",
                  "the range of a brick leaves out the samples on its far faces", "raycast"},
    PlantedDefect{Defect::ShiftedTable, "shifted table", "transfer table off by half a node", ""},
    PlantedDefect{Defect::CancellingSelfAttenuation, "cancelling self-attenuation",
                  "(1 - exp(-x)) / x of pre-integration by subtraction in float", ""},
    PlantedDefect{Defect::UnassociatedColours, "unassociated colours",
                  "pre-classified colours interpolated before they are multiplied by opacity", "texture3d_slices"},
    PlantedDefect{Defect::IsotropicGradients, "isotropic gradients", "gradients ignore unequal spacing", ""},
    PlantedDefect{Defect::PlacedInFloat, "placed in float", "world positions rounded to float before the subtraction",
                  ""},
    PlantedDefect{Defect::AxesTransposed, "axes transposed", "turned lattices turn the other way", ""},
    PlantedDefect{Defect::SignedOffByOne, "signed off by one", "16-bit signed voxels read one level too high", ""},
    PlantedDefect{Defect::UnnormalisedHalfway, "unnormalised halfway vector",
                  "l + v of the specular term not normalised", ""},
    PlantedDefect{Defect::UnboundedNormal, "unbounded normal", "a vanishing gradient is divided by its length", ""},
    PlantedDefect{Defect::OrderIgnored, "order ignored", "front to back draws back to front", "texture3d_slices"},
    PlantedDefect{Defect::WrongStack, "wrong stack", "the stack of slices is the one seen most from the side",
                  "slices2d"},
    PlantedDefect{Defect::ForgottenGutter, "forgotten gutter", "tiles lie one texel off their place", "slices2d"},
    PlantedDefect{Defect::EyeForgotten, "eye forgotten",
                  "slices on the other side of the eye are drawn in the order of those before it", "slices2d"},
    PlantedDefect{Defect::LostEdge, "lost edge", "the fill rule counts pixels on a shared edge never",
                  "texture3d_slices"},
};

}  // namespace volumark
