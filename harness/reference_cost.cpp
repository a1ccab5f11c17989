#include "harness/reference_cost.h"

#include <fmt/format.h>

#include "harness/progress.h"
#include "harness/scene_data.h"

namespace volumark {

double expected_reference_seconds(const Scene& scene, int width, int height) {
  // A ray is taken to pass as many cells as the volume, or one repeat of a shell's texture, has along its three edges.
  const double kSecondsPerCell = scene.display == Display::Shell ? 450e-9 : 20e-9;
  const glm::ivec3 size = data_of(scene).size;
  const double cells = size.x + size.y + size.z;
  return kSecondsPerCell * cells * width * height;
}

std::optional<std::string> too_costly(const Scene& scene, const Experiment& experiment, int width, int height,
                                      size_t views) {
  const double seconds = expected_reference_seconds(scene, width, height) * static_cast<double>(views);
  if (seconds <= experiment.reference_budget) return std::nullopt;
  const glm::ivec3 size = data_of(scene).size;
  return fmt::format(
      "its references would take about {} ({} views of {} x {} pixels through {} x {} x {} voxels), more than the "
      "experiment's reference_budget of {}; measure times alone with --no-reference, or choose a smaller image_size, "
      "fewer views or a larger reference_budget",
      duration_text(seconds), views, width, height, size.x, size.y, size.z, duration_text(experiment.reference_budget));
}

}  // namespace volumark
