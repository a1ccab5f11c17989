#include "methods/raycast/ray_parameters.h"

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "methods/volume/volume_uniforms.h"

namespace volumark {

using ray_parameters::kStep;
using ray_parameters::skips;

double texture_rounding(const Volume& volume, const std::string& format) {
  const double range = volume.max_value - volume.min_value;
  if (format == "r8") return range / 255 / 2;
  if (format == "r16") return range / 65535 / 2;
  if (format == "r16f") return range / 1024;
  return 0;
}

// Mesa's software drivers end the loops of a program, all together, after 65535 turns, and say nothing: what lies
// behind would be missing.
std::optional<std::string> too_many_segments(const Scene& scene, const Values& values, const BackendInfo& backend) {
  if (!scene.volume || backend.renderer.find("llvmpipe") == std::string::npos) return std::nullopt;
  constexpr double kTurns = 65535 - 64;
  const double each = skips(values) ? 2 : 1;  // looking up a brick is a turn of its own
  const double voxels = glm::length(scene.volume->extent()) / smallest_spacing(*scene.volume);
  if (voxels / kStep(values) * each <= kTurns) return std::nullopt;
  return fmt::format(
      "rays of up to {:.0f} segments: {} ends a program's loops after 65535 turns; a step of {:.3g} voxels is the "
      "least",
      voxels / kStep(values), backend.renderer, voxels * each / kTurns);
}

}  // namespace volumark
