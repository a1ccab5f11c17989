#include "harness/verify/sensitivity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "harness/scene_context.h"
#include "harness/scene_data.h"
#include "harness/statistics.h"
#include "harness/verify/edges.h"
#include "harness/verify/scene_shelf.h"

namespace volumark {
namespace {

constexpr int kSize = 48;
constexpr double kFactor = 20;  // curvature, and what the large motion averages out
constexpr size_t kListed = 32;

// Blends round: 2e-5 over the few hundred that a ray meets (300 * 2^-24).
constexpr double kBlendNoise = 2e-5;
// Places of samples are good to 2^-20 of the box. What a motion of so many sizes would change of a pixel is that much
// of what the large motion changes around it; rounding moves samples one by one, and so may change four times as much.
constexpr double kPlaceNoise = 4 * 0x1p-20 / kLargeMotion;

double pixel_change(const Image& a, const Image& b, size_t pixel) {
  double out = 0;
  for (size_t channel = 4 * pixel; channel < 4 * pixel + 4; ++channel) {
    const double d = std::abs(static_cast<double>(a.rgba[channel]) - static_cast<double>(b.rgba[channel]));
    out = std::isfinite(d) ? std::max(out, d) : std::numeric_limits<double>::max();
  }
  return out;
}

// Of each pixel, the largest over all directions.
std::vector<double> changes(const Image& base, const std::vector<Image>& moved) {
  std::vector<double> out(base.rgba.size() / 4);
  for (const Image& image : moved)
    for (size_t i = 0; i < out.size(); ++i) out[i] = std::max(out[i], pixel_change(base, image, i));
  return out;
}

double largest_around(const std::vector<double>& values, int width, int height, int x, int y) {
  double out = 0;
  for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
    for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
      out = std::max(out, values[static_cast<size_t>(v) * static_cast<size_t>(width) + static_cast<size_t>(u)]);
  return out;
}

glm::dvec3 direction(int k) {
  const double azimuth = 2 * std::numbers::pi * k / kDirections, height = std::sin(1.7 * k);
  return {std::cos(azimuth) * std::cos(height), std::sin(height), std::sin(azimuth) * std::cos(height)};
}

View moved(View view, const glm::dvec3& motion) {
  view.eye += motion;
  view.target += motion;
  return view;
}

SensitivityFrames draw_frames(FrameSource& source, const View& view, double size) {
  const auto draw = [&](const View& from) {
    source.frame(from);
    return source.read_back();
  };
  SensitivityFrames frames;
  frames.base = draw(view);
  for (int k = 0; k < kDirections; ++k) {
    frames.small_motion.push_back(draw(moved(view, kSmallMotion * size * direction(k))));
    frames.large_motion.push_back(draw(moved(view, kLargeMotion * size * direction(k))));
  }
  return frames;
}

// Of a scene with edges: the pixels of `row` that an edge passes, each followed along the direction that changes
// it most. None where more would be than edges pass in proportion.
std::vector<bool> passed_by_edges(FrameSource& source, const View& view, double size, const SensitivityFrames& frames,
                                  const SensitivityRow& row) {
  const auto width = static_cast<size_t>(frames.base.width);
  std::vector<bool> out(frames.base.rgba.size() / 4);
  size_t edges = 0;
  double least = std::numeric_limits<double>::max();
  for (const Spike& spike : row.spikes) {
    const int x = static_cast<int>(spike.x), y = static_cast<int>(spike.y);
    const size_t pixel = static_cast<size_t>(y) * width + static_cast<size_t>(x);
    int steepest = 0;
    double change = 0;
    for (int k = 0; k < kDirections; ++k) {
      const double here = pixel_change(frames.base, frames.small_motion[static_cast<size_t>(k)], pixel);
      if (here > change) {
        change = here;
        steepest = k;
      }
    }
    std::vector<PixelValue> along;
    for (const double place : kEdgePlaces) {
      source.frame(moved(view, place * kSmallMotion * size * direction(steepest)));
      const Image image = source.read_back();
      const float* value = image.pixel(x, y);
      along.push_back({value[0], value[1], value[2], value[3]});
    }
    if (!is_passing_edge(along)) continue;
    out[pixel] = true;
    ++edges;
    least = std::min(least, change);
  }
  const std::vector<double> large = changes(frames.base, frames.large_motion);
  const auto jumps = std::count_if(large.begin(), large.end(), [&](double change) { return change >= least / 2; });
  if (edges > edges_allowed(static_cast<size_t>(jumps))) out.clear();
  return out;
}

void add_rows(CaseRun& run, const Scene& scene, const Values& values, FrameSource& source,
              std::vector<SensitivityRow>& rows) {
  const double size = data_of(scene).diameter;
  const SensitivityFrames frames = draw_frames(source, scene.views.front(), size);
  double worst = 0;
  SensitivityRow row = judge_sensitivity(frames, 0, worst);
  if (!row.ok && has_edges(scene)) {
    const std::vector<bool> edges = passed_by_edges(source, scene.views.front(), size, frames, row);
    row = judge_sensitivity(frames, 0, worst, edges);
    const auto passed = std::count(edges.begin(), edges.end(), true);
    if (row.ok) row.reason = fmt::format("{} pixels left out, which an edge of the picture passes", passed);
  }
  row.key.experiment = "verify";
  row.key.scene = scene.name;
  row.key.method = run.method().info().name;
  row.key.backend = run.device().info().id;
  row.key.params.insert(values.begin(), values.end());
  HardCaseRow check =
      run.new_row(scene.name + ": worst pixel of a small motion against its neighbourhood of a large one",
                  "20 times the change per motion within a pixel under a hundred times the motion; noise taken off");
  check.measured = check.deviation = worst;
  check.bound = 1;
  check.outcome = row.ok ? "pass" : "fail";
  check.reason = row.reason;
  if (!row.spikes.empty()) {
    check.x = row.spikes.front().x;
    check.y = row.spikes.front().y;
  }
  run.add_row(std::move(check), &frames.base, nullptr);
  rows.push_back(std::move(row));
}

}  // namespace

SensitivityRow judge_sensitivity(const SensitivityFrames& frames, int64_t view, double& worst,
                                 const std::vector<bool>& edges) {
  const int width = frames.base.width, height = frames.base.height;
  const std::vector<double> little = changes(frames.base, frames.small_motion);
  const std::vector<double> large = changes(frames.base, frames.large_motion);
  SensitivityRow row;
  row.directions = static_cast<int64_t>(frames.small_motion.size());
  row.motion = kSmallMotion;
  std::vector<double> per_motion;
  worst = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto i = static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
      if (!edges.empty() && edges[i]) continue;
      const double around = largest_around(large, width, height, x, y);
      const double noise = kBlendNoise + kPlaceNoise * around;
      const double small_change = std::max(little[i] - noise, 0.0) / kSmallMotion;
      const double change = std::max(small_change, std::max(large[i] - noise, 0.0) / kLargeMotion);
      if (change > 0) per_motion.push_back(change);
      const double limit = kFactor * std::max(around, kBlendNoise) / kLargeMotion;
      if (small_change > limit) row.spikes.push_back({view, x, y, small_change});
      const bool worse = small_change / limit > worst, steeper = worst == 0 && limit > row.limit;
      if (worse || steeper) row.limit = limit;
      worst = std::max(worst, small_change / limit);
    }
  std::sort(per_motion.begin(), per_motion.end());
  if (!per_motion.empty()) {
    row.median = per_motion[per_motion.size() / 2];
    row.p99 = per_motion[per_motion.size() * 99 / 100];
    row.max = per_motion.back();
  }
  std::sort(row.spikes.begin(), row.spikes.end(), [](const Spike& a, const Spike& b) { return a.change > b.change; });
  row.spike_count = static_cast<int64_t>(row.spikes.size());
  row.ok = row.spikes.empty();
  if (!row.ok)
    row.reason = fmt::format(
        "{} pixels change out of proportion, the worst at {}, {}: by {:.3g} a size of the scene, "
        "{:.3g} times what is allowed there",
        row.spike_count, row.spikes.front().x, row.spikes.front().y, row.spikes.front().change, worst);
  if (row.spikes.size() > kListed) row.spikes.resize(kListed);
  return row;
}

void run_sensitivity(CaseRun& run, std::vector<SensitivityRow>& rows, std::vector<SceneResultInfo>& scenes) {
  for (const SceneShelf::Entry& entry : run.scenes().entries()) {
    if (!entry.scene) {
      run.not_applicable(entry.name, entry.missing);
      continue;
    }
    const Scene& scene = *entry.scene;
    try {
      const Values values = run.scene_values(scene);
      const auto source = run.prepare(scene, values, kSize, kSize);
      add_rows(run, scene, values, *source, rows);
    } catch (const NotApplicable& why) {
      run.not_applicable(entry.name, why.what());
      continue;
    }
    const auto known = [&](const SceneResultInfo& info) { return info.name == scene.name; };
    if (std::none_of(scenes.begin(), scenes.end(), known)) scenes.push_back(scene_result_info(scene));
  }
}

}  // namespace volumark
