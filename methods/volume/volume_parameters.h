// The parameters that methods on 3D textures have in common. Declared here once; each method lists those that it reads.
#pragma once

#include "backends/types.h"
#include "methods/parameters.h"

namespace volumark {

enum class Classification { Post, Pre, Preintegrated };  // as VM_CLASSIFICATION in volume_common.glsl

namespace volume_parameters {

inline const Choice kVolumeFormat{
    "volume_format",
    "texels of the volume texture; native: as stored in the data (u8: r8, u16 and i16: r16, f32: r32f)",
    {"native", "r8", "r16", "r16f", "r32f"},
    "native",
    Ideal<const char*>{"r32f", "volume texture and filter"}};

inline const Choice kTargetFormat{"target_format",
                                  "texels of the colour target that slices or samples are blended into",
                                  {"rgba32f", "rgba16f", "rgba8"},
                                  "rgba32f",
                                  Ideal<const char*>{"rgba32f", "target format"}};

inline const Choice kClassification{
    "classification",
    "post: the transfer function is applied to interpolated samples; pre: to the voxels, whose associated colours are "
    "interpolated; preintegrated: to the linear run of values between the two ends of each segment",
    {"post", "pre", "preintegrated"},
    "post",
    Ideal<const char*>{"post", "classification"}};

inline const Integer kTableSize{{"table_size",
                                 "nodes",
                                 "transfer function table; 1021 holds every quarter of a level of an 8-bit window",
                                 1021,
                                 2,
                                 8192,
                                 {},
                                 Ideal<int64_t>{8192, "table size"}}};

inline const Integer kPreintegratedSize{{"preintegrated_size",
                                         "nodes",
                                         "nodes along each side of the pre-integration table",
                                         256,
                                         2,
                                         2048,
                                         {},
                                         Ideal<int64_t>{1024, "pre-integration table"}}};

inline const Choice kOpacityCorrection{"opacity_correction",
                                       "opacity of a segment d of extinction tau; exact: 1 - exp(-tau d), linear: "
                                       "min(tau d, 1)",
                                       {"exact", "linear"},
                                       "exact",
                                       Ideal<const char*>{"exact", "opacity correction"}};

}  // namespace volume_parameters

inline Format target_format_of(const Values& values) {
  constexpr Format kFormats[] = {Format::RGBA32F, Format::RGBA16F, Format::RGBA8};
  return kFormats[volume_parameters::kTargetFormat.index(values)];
}
inline Classification classification_of(const Values& values) {
  return static_cast<Classification>(volume_parameters::kClassification.index(values));
}

}  // namespace volumark
