#include "harness/reference_cost.h"

#include <fmt/format.h>

#include "harness/progress.h"

namespace volumark {

double expected_reference_seconds(const Scene& scene, int width, int height) {
  constexpr double kSecondsPerCell = 20e-9;
  if (!scene.volume) return 0;
  const double cells = scene.volume->size.x + scene.volume->size.y + scene.volume->size.z;
  return kSecondsPerCell * cells * width * height;
}

std::optional<std::string> too_costly(const Scene& scene, const Experiment& experiment, int width, int height,
                                      size_t views) {
  const double seconds = expected_reference_seconds(scene, width, height) * static_cast<double>(views);
  if (seconds <= experiment.reference_budget) return std::nullopt;
  const glm::ivec3& size = scene.volume->size;
  return fmt::format(
      "its references would take about {} ({} views of {} x {} pixels through {} x {} x {} voxels), more than the "
      "experiment's reference_budget of {}; measure times alone with --no-reference, or choose a smaller image_size, "
      "fewer views or a larger reference_budget",
      duration_text(seconds), views, width, height, size.x, size.y, size.z, duration_text(experiment.reference_budget));
}

}  // namespace volumark
