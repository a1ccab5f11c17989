// Parameters that the methods with slices perpendicular to the view have in common.
#pragma once

#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_uniforms.h"

namespace volumark {

namespace slice_parameters {

inline const Number kStep{{"step",
                           "voxels",
                           "distance of the slices, in the smallest voxel spacing",
                           1,
                           1. / 64,
                           64,
                           {8, 4, 2, 1, .5, .25},
                           Ideal<double>{.125, "step"}}};

inline const Choice kOrder{"order",
                           "back_to_front blends each slice over, front_to_back under what is there",
                           {"back_to_front", "front_to_back"},
                           "back_to_front"};

inline const Choice kEndSlabs{
    "end_slabs",
    "clipped: each sample stands for the part of its slab inside the volume; full: for the whole slab (plain slices)",
    {"clipped", "full"},
    "clipped",
    Ideal<const char*>{"clipped", "end slabs"}};

}  // namespace slice_parameters

inline bool clips_slabs(const Values& values) { return slice_parameters::kEndSlabs(values) == "clipped"; }

// Distance of the slices. `scene.volume` is loaded.
inline double step_in_world(const Scene& scene, const Values& values) {
  return slice_parameters::kStep(values) * smallest_spacing(*scene.volume);
}

}  // namespace volumark
