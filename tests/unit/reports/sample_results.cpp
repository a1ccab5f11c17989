#include "tests/unit/reports/sample_results.h"

#include <limits>

namespace volumark {
namespace {

const std::string kSha(64, 'a');

ErrorMetrics errors(double rmse) {
  ErrorMetrics out;
  out.pixels = 64;
  out.rmse = rmse;
  out.mae = rmse / 2;
  out.max = rmse * 4;
  out.max_x = 3;
  out.max_y = 5;
  out.psnr = std::numeric_limits<double>::infinity();
  out.bias = {0.001, -0.002, 0};
  out.ssim = std::numeric_limits<double>::quiet_NaN();
  out.regions["interior"] = {40, rmse, rmse * 2, rmse / 2};
  return out;
}

Metric seconds(std::vector<double> samples) {
  Metric metric;
  metric.views.assign(samples.size(), 0);
  metric.stats = {static_cast<int64_t>(samples.size()), 0.02, 0.01, 0.03, 0.02, 0.01, 0.03, 0.015, 0.025};
  metric.samples = std::move(samples);
  metric.first = 0.5;
  return metric;
}

}  // namespace

Results sample_results() {
  Results results;
  results.run = {
      "20260101-1", "2026-01-01T10:00:00Z", "", {"volumark", "run", "quick"}, "random interleaving", 1, true, 1};
  results.git = {"0123abc", "main", "2026-01-01T09:00:00Z", true};
  results.build = {"GNU", "12.2.0", "-O3", "Release"};
  results.machine = {"CPU", "Debian 12", "", 2, int64_t{1} << 34, {0.5, 0.25, 0}, {1, 1, 1}, {{"LP_NUM_THREADS", "2"}}};
  results.backends = {{"cpu", "volumark", "us", "SIMD", "1", "", "", 256, 2, true, {}, {"Compute"}, {}}};
  results.experiments = {{"quick", "Quick", "All scenes", {{"rmse", 0.05}}}};
  results.scenes = {
      {"sphere", "A sphere", "", kSha, {8, 8, 8}, "F32", "MIT", "procedural", {"lighting"}, {"front"}, {0, 0, 0}}};
  results.methods = {{"raycast", "Ray casting", "levoy1988", {{"step", "voxels", "Step", true}}}};

  Result good;
  good.key = {"quick", "sphere", "raycast", "cpu", {{"step", 0.5}, {"n", int64_t{3}}, {"on", true}, {"mode", "post"}}};
  good.case_version = "v1";
  good.outcome = Outcome::Ok;
  good.effects = {"lighting"};
  good.width = good.height = 8;
  good.quality = Quality{"step", 0.5};
  Metrics metrics;
  metrics.frame_wall = seconds({0.01, 0.02, 0.03});
  metrics.frame_cpu = seconds({0.02, 0.04, 0.06});
  metrics.zones["raster"] = seconds({0.01, 0.01, 0.01});
  metrics.prepare = {0.1, 0.2, {{"upload", 0.05}}};
  metrics.counters["samples"] = 1234.5;
  metrics.peak_bytes = {1024, 4096, 512, 1024};
  metrics.timing = {"precision", 0.02, 1};
  good.metrics = metrics;
  ViewResult view;
  view.name = "front";
  view.frame_wall = metrics.frame_wall.stats;
  view.counters["samples"] = 1234;
  view.reference = ReferenceInfo{"key", kSha, 1e-6, true, {"ground_fog"}};
  view.error = errors(0.01);
  view.rendered = ImageFile{"images/a.exr", kSha, 8, 8, "linear", "images/a.png"};
  good.views = {view};
  good.error = CellError{errors(0.01), errors(0.005)};
  good.order = {2, 1.97};
  good.paper = PaperCell{"cabral1994", "1", "frames", "1/s", "ratio", 3.5};
  good.command = "volumark run quick";
  good.finished_at = "2026-01-01T10:00:01Z";

  Result bad;
  bad.key = {"quick", "sphere", "raycast", "gl", {}};
  bad.case_version = "v1";
  bad.outcome = Outcome::Unsupported;
  bad.reason = "no compute";
  bad.command = "volumark run quick";
  results.results = {good, bad};

  Convergence row;
  row.key = good.key;
  row.parameter = "step";
  row.values = {2, 1, 0.5};
  row.errors = {0.04, 0.01, 0.0025};
  row.fitted_points = 3;
  row.fitted = row.fitted_lo = row.fitted_hi = row.expected = 2;
  row.verdict = "pass";
  results.convergence = {row};
  ParityRow parity;
  parity.key = good.key;
  parity.other = "gl";
  parity.interior_max = std::numeric_limits<double>::infinity();
  parity.limit = 2e-3;
  results.parity = {parity};
  results.claims = {{"c1", "faster", "ratio > 1", "holds", "", 2, 1}};
  Claim& unknown = results.claims.emplace_back(results.claims.front());
  unknown.verdict = "unknown";
  unknown.measured = unknown.measured_lo = std::numeric_limits<double>::quiet_NaN();
  unknown.limit_lo = 1.5;  // and no limit above
  unknown.cells = {results.results.front().key};
  results.self_test = {{"flip", "black/white", "paper", 0.967388, 0.9673881, 1e-5, true}};
  return results;
}

}  // namespace volumark
