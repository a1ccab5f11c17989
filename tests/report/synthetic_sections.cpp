#include "tests/report/synthetic_sections.h"

#include <cmath>
#include <limits>

#include "harness/metrics/metrics.h"
#include "tests/report/png_writer.h"
#include "tests/report/synthetic_pictures.h"

namespace volumark::report_test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

ImageFile picture(const std::filesystem::path& folder, const std::string& path, const Image& image) {
  write_png(folder / path, image);
  return {path, std::string(64, '0'), image.width, image.height, "srgb", path};
}

// The finest cell of a method on a backend.
const Result* finest(const Results& results, const std::string& scene, const std::string& method,
                     const std::string& backend) {
  const Result* out = nullptr;
  for (const Result& cell : results.results)
    if (cell.key.scene == scene && cell.key.method == method && cell.key.backend == backend && cell.error &&
        cell.key.variant.empty() && (out == nullptr || cell.error->worst.rmse < out->error->worst.rmse))
      out = &cell;
  return out;
}

void add_attribution(Results& results) {
  for (const char* backend : {"gl", "cpu"})
    for (const char* method : {"texture3d_slices", "raycast"}) {
      const Result& cell = *finest(results, results.scenes[0].name, method, backend);
      Attribution row;
      row.key = cell.key;
      row.error = cell.error->worst.rmse;
      row.seconds = cell.metrics->frame_wall.stats.median;
      auto part = [&](const char* aspect, const char* parameter, double worth, const char* note) {
        row.parts.push_back({aspect, parameter, std::string("from"), std::string("to <ideal>"),
                             row.error * std::sqrt(1 - worth), worth, row.seconds * 1.5, note});
      };
      part("step", "step", .62, "");
      part("volume texture", "volume_format", .31, "gl filters R8 textures with 8 bits (256 levels met)");
      part("target format", "target_format", .002, "");
      part("table size", "table_size", -.21, "");
      row.parts.push_back({"brick size", "brick_size", int64_t{8}, int64_t{1}, kNan, kNan, 0, "out of memory"});
      row.all_ideal = row.error * .2;
      row.bound = 4e-6;
      row.command = "volumark run quick --scene ball --method " + std::string(method);
      results.attribution.push_back(row);
    }
  results.attribution[1].parts.clear();  // nothing left to make ideal
}

void add_pairs(Results& results) {
  for (const char* backend : {"gl", "vulkan", "cpu"})
    for (const SceneResultInfo& scene : results.scenes) {
      const Result *a = finest(results, scene.name, "texture3d_slices", backend),
                   *b = finest(results, scene.name, "raycast", backend);
      const bool near = backend == std::string("cpu");
      results.pairs.push_back({a->key, b->key, 1, 3.25e-5, 4e-4, .003, 0, 0, 4e-6, near ? "indistinguishable" : "b",
                               near ? "b" : "a", near ? "the intervals of the errors overlap" : ""});
    }
}

Stats around(double median) {
  return {9, median, median * .9, median * 1.1, median, median * .8, median * 1.2, median * .98, median * 1.02};
}

// Cells of an experiment that switches the effects of the first scene: "" and "none".
void add_effects(Results& results, const std::filesystem::path& folder) {
  results.experiments.push_back({"effects", "Effects on and off", "", {}});
  for (const char* method : {"texture3d_slices", "raycast"})
    for (const char* backend : {"gl", "cpu"}) {
      Result cell = *finest(results, results.scenes[0].name, method, backend);
      cell.key.experiment = "effects";
      const double seconds = cell.metrics->frame_wall.stats.median;
      cell.programs = {{method, "vertex", 20}, {method, "fragment", 392}};
      results.results.push_back(cell);
      EffectRow row;
      row.key = cell.key;
      row.effect = "lighting";
      row.mode = "leave_one_out";
      row.with = around(seconds);
      row.without = around(seconds * .8);
      row.rmse = .05;
      row.flip_p99 = .2;
      row.instructions_with = 412;
      row.instructions_without = 340;
      row.time_differs = backend == std::string("gl");
      results.effects.push_back(row);
      row.mode = "single";
      row.without = {};  // not timed
      results.effects.push_back(row);
      cell.key.variant = "none";
      cell.views.resize(1);
      cell.views[0].rendered =
          picture(folder, std::string("images/none-") + method + "-" + backend + ".png", ball(1, 0, 0, 0, 0));
      cell.views[0].flip = cell.views[0].difference = std::nullopt;
      results.results.push_back(cell);
    }
}

HardCaseRow hard_case(const char* id, const char* number, const char* title, const char* method, const char* backend) {
  HardCaseRow row;
  row.id = id;
  row.number = number;
  row.title = title;
  row.check = "largest deviation";
  row.method = method;
  row.backend = backend;
  row.expected = .6321205588;
  row.outcome = "pass";
  row.source = "1 - exp(-1); float rounding of 1000 slices";
  row.seconds = .01;
  row.command = std::string("volumark verify --case ") + id;
  return row;
}

void add_hard_cases(Results& results, const std::filesystem::path& folder) {
  auto add = [&](HardCaseRow row, double deviation, double bound) {
    row.measured = row.expected + deviation;
    row.deviation = deviation;
    row.bound = bound;
    if (!(deviation <= bound)) row.outcome = "fail";
    results.hard_cases.push_back(row);
  };
  for (const char* method : {"texture3d_slices", "raycast"})
    for (const char* backend : {"gl", "vulkan", "cpu"}) {
      add(hard_case("slab", "1", "Homogeneous slab", method, backend), 2.5e-6, 1e-5);
      add(hard_case("tangent_step", "23b", "Step function tangent to the ray", method, backend),
          method == std::string("raycast") && backend == std::string("gl") ? 3e-3 : 8e-5, 1e-3);
    }
  HardCaseRow& failed = results.hard_cases[7];
  failed.reason = "pixel 20, 31 is <off>";
  for (HardCaseRow& row : results.hard_cases) {
    if (row.id != "tangent_step" || row.outcome != "fail") continue;
    row.x = 20;
    row.y = 31;
    row.picture = picture(folder, "images/tangent.png", ball(0, 0, 2, .1, 3));
    row.difference = picture(folder, "images/tangent-difference.png",
                             signed_difference_picture(ball(0, 0, 2, .1, 3), ball(0, 0, 0, 0, 3)));
  }
  add(hard_case("exact_zero", "8", "Associated colours", "", "cpu"), 0, 0);
  add(hard_case("not_a_number", "23", "Data that are no numbers", "raycast", "gl"), kNan, 1e-3);
  HardCaseRow none = hard_case("opacity", "5", "Opacity correction", "raycast", "cpu");
  none.outcome = "not_applicable";
  none.reason = "the method has no uncorrected opacity";
  none.measured = none.deviation = kNan;
  results.hard_cases.push_back(none);
  HardCaseRow broken = hard_case("tiny_volumes", "23", "Volumes of one voxel", "texture3d_slices", "vulkan");
  broken.outcome = "error";
  broken.reason = "the method threw: <size 0>";
  results.hard_cases.push_back(broken);
}

// Of the same motion as add_sensitivity: the pixel that comes nearest to its own limit.
void add_motion_checks(Results& results) {
  for (const auto& [method, share] : {std::pair("texture3d_slices", .4), std::pair("raycast", 26.0)}) {
    HardCaseRow row = hard_case("sensitivity", "24", "The picture follows the camera", method, "gl");
    row.check = results.scenes[0].name + ": worst pixel of a small motion";
    row.expected = 0;
    row.measured = row.deviation = share;
    row.bound = 1;
    row.outcome = share > 1 ? "fail" : "pass";
    results.hard_cases.push_back(row);
  }
}

void add_sensitivity(Results& results) {
  for (const char* method : {"texture3d_slices", "raycast"}) {
    SensitivityRow row;
    row.key = finest(results, results.scenes[0].name, method, "gl")->key;
    row.directions = 16;
    row.motion = 1e-6;
    row.median = 1.5;
    row.p99 = 9;
    row.max = 14;
    row.limit = 200;
    row.ok = true;
    if (method == std::string("raycast")) {
      row.max = 5200;
      row.spikes = {{0, 40, 30, 5200}, {0, 44, 60, 900}, {1, 3, 3, 300}};
      row.spike_count = 41;
      row.ok = false;
      row.reason = "a branch flips along the edge";
    }
    results.sensitivity.push_back(row);
  }
}

}  // namespace

void add_sections(Results& results, const std::filesystem::path& folder) {
  for (BackendResultInfo& backend : results.backends)
    backend.filter_levels = {{"r8", backend.id == "gl" ? 257.0 : 4096.0}, {"r32f", 4096}};
  add_attribution(results);
  add_pairs(results);
  add_effects(results, folder);
  add_hard_cases(results, folder);
  add_motion_checks(results);
  add_sensitivity(results);
  for (size_t i = 0; i < results.convergence.size(); i += 3) {
    results.convergence[i].floor = results.convergence[i].errors.back();
    results.convergence[i].floor_reason = "volume texture and filter (98 % of the squared error)";
  }
}

}  // namespace volumark::report_test
