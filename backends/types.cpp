#include "backends/types.h"

namespace volumark {
namespace {

struct FormatRow {
  const char* name;
  size_t bytes;
  int channels;
};
constexpr FormatRow kFormats[] = {{"r8", 1, 1},      {"r16", 2, 1},      {"r16f", 2, 1},
                                  {"r32f", 4, 1},    {"rg8", 2, 2},      {"rgba8", 4, 4},
                                  {"rgba16f", 8, 4}, {"rgba32f", 16, 4}, {"d32fs8", 8, 2}};

}  // namespace

size_t texel_bytes(Format format) { return kFormats[static_cast<size_t>(format)].bytes; }
int channel_count(Format format) { return kFormats[static_cast<size_t>(format)].channels; }
const char* to_string(Format format) { return kFormats[static_cast<size_t>(format)].name; }
bool is_depth_stencil(Format format) { return format == Format::D32FS8; }

const char* to_string(Capability capability) {
  constexpr const char* kNames[] = {"geometry_stage", "compute", "storage_images", "gpu_timers", "float64"};
  return kNames[static_cast<size_t>(capability)];
}

}  // namespace volumark
