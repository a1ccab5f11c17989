// The same cell on every backend: what one of them does with the text of a program, the others must do too.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "harness/metrics/metrics.h"
#include "harness/verify/cases.h"
#include "harness/verify/scene_shelf.h"
#include "scenes/shell.h"

namespace volumark::hard_cases {
namespace {

constexpr int kSize = 64;

struct Drawn {
  std::string backend;
  Image image;
};

void compare(CaseRun& run, const std::string& scene, const Drawn& one, const Drawn& other) {
  const ParityLimits limits;
  const Parity found = parity(one.image, other.image, limits);
  HardCaseRow interior =
      run.new_row(fmt::format("{}: interior pixels, {} against {}", scene, one.backend, other.backend),
                  "2e-3: float rounding over some hundred samples, with room");
  interior.backend = one.backend;
  interior.measured = interior.deviation = std::min(found.interior_max, std::numeric_limits<double>::max());
  interior.bound = limits.difference;
  interior.x = found.interior_x;
  interior.y = found.interior_y;
  HardCaseRow rim = run.new_row(
      fmt::format("{}: share of silhouette pixels beyond 2e-3, {} against {}", scene, one.backend, other.backend),
      "a thousandth: where a ray grazes, rounding decides whether it hits");
  rim.backend = one.backend;
  rim.measured = rim.deviation = found.silhouette_fraction;
  rim.bound = limits.silhouette_fraction;
  for (HardCaseRow* row : {&interior, &rim}) {
    row->outcome = row->deviation <= row->bound ? "pass" : "fail";
    if (row->outcome == "fail")
      row->reason =
          fmt::format("{:.3g} is more than {:.3g}; silhouettes: {} of {} pixels, at most {:.3g}", row->measured,
                      row->bound, found.silhouette_over, found.silhouette_pixels, found.silhouette_max);
  }
  run.add_row(std::move(interior), &one.image, &other.image);
  run.add_row(std::move(rim), &one.image, &other.image);
}

// Rasterizers snap corners to 1/256 of a pixel, each in its own way, and what a polygon interpolates moves with them.
// Where a shell is so thin in the picture that this is a good part of a texel of its height, places differ by more than
// the rounding of floats: no limit between backends is known there.
void refuse_thin_shell(const Scene& scene, const View& view) {
  constexpr double kSnap = 1. / 256, kTexels = 0.25;
  if (!scene.shell) return;
  const ShellBounds bounds = bounds_of(*scene.shell);
  const double away = glm::distance(view.eye, 0.5 * (bounds.lo + bounds.hi));
  const double half = view.perspective ? away * std::tan(0.5 * view.fov_y) : view.half_height;
  const double pixel = 2 * half / kSize;
  const double thickest = *std::max_element(scene.shell->thickness.begin(), scene.shell->thickness.end());
  const double moved = kSnap * pixel / thickest * scene.shell->colours->size.z;
  if (moved > kTexels)
    throw NotApplicable(fmt::format(
        "the shell is {:.2g} pixels thick: 1/256 of a pixel, to which corners snap, is {:.2g} texels of its height",
        thickest / pixel, moved));
}

}  // namespace

void agreement(CaseRun& run) {
  if (run.devices().size() < 2)
    throw NotApplicable("it compares backends, and only one was asked for or can be opened");
  for (const SceneShelf::Entry& entry : run.scenes().entries()) {
    if (!entry.scene) {
      run.not_applicable(entry.name, entry.missing);
      continue;
    }
    try {
      const View& view = entry.scene->views[entry.scene->views.size() > 1 ? 1 : 0];
      refuse_thin_shell(*entry.scene, view);
      std::vector<Drawn> drawn;
      for (const auto& [id, device] : run.devices()) {
        const auto source = run.prepare(*entry.scene, run.scene_values(*entry.scene), kSize, kSize, *device);
        source->frame(view);
        drawn.push_back({id, source->read_back()});
      }
      for (size_t i = 0; i < drawn.size(); ++i)
        for (size_t k = i + 1; k < drawn.size(); ++k) compare(run, entry.name, drawn[i], drawn[k]);
    } catch (const NotApplicable& why) {
      run.not_applicable(entry.name, why.what());
    }
  }
}

}  // namespace volumark::hard_cases
