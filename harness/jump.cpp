#include "harness/jump.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "harness/metrics/metrics.h"

namespace volumark {
namespace {

bool neighbours(const View& a, const View& b) {
  const glm::dvec3 u = frame_of(a).forward, v = frame_of(b).forward;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v)) <= kNeighbourAngle;
}

// Picture and reference of a view, over the background.
struct Drawn {
  Image picture, reference;
};

std::optional<Drawn> drawn(const SceneContext& context, const std::map<int, Image>& images, int view) {
  const auto image = images.find(view);
  const auto reference = context.references.find(view);
  if (image == images.end() || reference == context.references.end()) return std::nullopt;
  const glm::dvec3& background = context.scene.background;
  return Drawn{composite(image->second, background), composite(reference->second.image, background)};
}

double change_of_error(const Drawn& a, const Drawn& b) {
  double sum = 0;
  for (size_t i = 0; i < a.picture.rgba.size(); ++i) {
    if (i % 4 == 3) continue;
    const auto error = [&](const Drawn& of) {
      return static_cast<double>(of.picture.rgba[i]) - static_cast<double>(of.reference.rgba[i]);
    };
    const double change = error(b) - error(a);
    sum += change * change;
  }
  return std::sqrt(sum / (0.75 * static_cast<double>(a.picture.rgba.size())));
}

}  // namespace

void measure_jumps(const SceneContext& context, const std::map<int, Image>& images, Result& result) {
  for (size_t i = 1; i < result.views.size(); ++i) {
    const auto here = static_cast<int>(result.views[i].index), before = static_cast<int>(result.views[i - 1].index);
    const auto& views = context.scene.views;
    if (!neighbours(views[static_cast<size_t>(before)], views[static_cast<size_t>(here)])) continue;
    const std::optional<Drawn> a = drawn(context, images, before), b = drawn(context, images, here);
    if (!a || !b) continue;
    const double jump = change_of_error(*a, *b);
    if (std::isfinite(jump)) result.views[i].jump = jump;
  }
}

}  // namespace volumark
