// Parameters that the methods on stacks of 2D slices have in common, beside those of
// methods/volume/volume_parameters.h.
#pragma once

#include "methods/volume/volume_parameters.h"
#include "methods/volume/volume_resources.h"

namespace volumark {

namespace stack_parameters {

inline const Choice kClassification{
    "classification",
    "post: the transfer function is applied to interpolated samples; pre: to the voxels, whose associated colours are "
    "interpolated (paletted textures)",
    {"post", "pre"},
    "post",
    Ideal<const char*>{"post", "classification"}};

}  // namespace stack_parameters

inline Classification stack_classification_of(const Values& values) {
  return stack_parameters::kClassification.index(values) == 0 ? Classification::Post : Classification::Pre;
}

// From volume_format, classification and table_size.
inline VolumeSettings stack_settings_of(const Values& values) {
  VolumeSettings settings;
  settings.volume_format = volume_parameters::kVolumeFormat(values);
  settings.classification = stack_classification_of(values);
  settings.table_size = static_cast<int>(volume_parameters::kTableSize(values));
  return settings;
}

}  // namespace volumark
