#include "reports/measures.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/analysis.h"

namespace volumark {
namespace {

constexpr std::array kErrors = {"rmse", "max",           "mae",   "flip_mean", "flip_p99",
                                "bias", "ciede2000_p99", "dssim", "jump"};
constexpr std::array kBytes = {"device", "process", "voxels", "target"};

// "counter.slices": "slices" where the prefix is "counter.".
std::optional<std::string> after(const std::string& measure, const std::string& prefix) {
  if (!measure.starts_with(prefix) || measure.size() == prefix.size()) return std::nullopt;
  return measure.substr(prefix.size());
}

std::optional<Measured> of_samples(const Metric& metric) {
  const Stats& stats = metric.stats;
  if (stats.count == 0) return std::nullopt;
  return Measured{stats.median, stats.median_lo, stats.median_hi};
}

Measured plain(double value) { return {value, value, value}; }

// The largest of all views; each of the two references that it takes part in may be off by its bound.
std::optional<Measured> of_jump(const Result& result) {
  std::optional<Measured> out;
  for (size_t i = 0; i < result.views.size(); ++i) {
    const ViewResult& view = result.views[i];
    if (!view.jump || (out && *view.jump <= out->value)) continue;
    double bound = 0;
    for (const ViewResult* one : {&result.views[i - (i > 0 ? 1 : 0)], &view})
      if (one->reference) bound += one->reference->bound;
    out = Measured{*view.jump, std::max(0.0, *view.jump - bound), *view.jump + bound};
  }
  return out;
}

std::optional<Measured> of_error(const Result& result, const std::string& metric) {
  const bool all_empty =
      std::all_of(result.views.begin(), result.views.end(), [](const ViewResult& view) { return view.shows_nothing; });
  if (!result.error || (all_empty && !result.views.empty())) return std::nullopt;
  const double value = error_value(result.error->worst, metric);
  if (!std::isfinite(value)) return std::nullopt;
  double bound = 0;
  if (metric == "rmse" || metric == "max" || metric == "mae")
    for (const ViewResult& view : result.views)
      if (view.reference) bound = std::max(bound, view.reference->bound);
  return Measured{value, std::max(0.0, value - bound), value + bound};
}

double bytes_of(const PeakBytes& bytes, const std::string& name) {
  return static_cast<double>(name == "device"    ? bytes.device
                             : name == "process" ? bytes.process
                             : name == "voxels"  ? bytes.voxels
                                                 : bytes.target);
}

std::optional<Measured> instructions(const Result& result) {
  if (result.programs.empty()) return std::nullopt;
  double sum = 0;
  for (const ProgramCost& cost : result.programs) sum += static_cast<double>(cost.instructions);
  return plain(sum);
}

template <class Map>
auto look_up(const Map& map, const std::string& name) {
  const auto found = map.find(name);
  return found == map.end() ? nullptr : &found->second;
}

}  // namespace

std::string measure_fault(const std::string& measure) {
  for (const char* known : {"frame_wall", "frame_cpu", "prepare.wall", "prepare.cpu", "instructions"})
    if (measure == known) return "";
  if (after(measure, "counter.") || after(measure, "zone.")) return "";
  const auto error = after(measure, "error."), bytes = after(measure, "peak_bytes.");
  if (error && std::find(kErrors.begin(), kErrors.end(), *error) != kErrors.end()) return "";
  if (bytes && std::find(kBytes.begin(), kBytes.end(), *bytes) != kBytes.end()) return "";
  return "unknown measure \"" + measure +
         "\"; known: frame_wall, frame_cpu, prepare.wall, prepare.cpu, instructions, counter.NAME, zone.NAME, "
         "peak_bytes.device (process, voxels, target), error.rmse (max, mae, flip_mean, flip_p99, bias, ciede2000_p99, "
         "dssim, jump)";
}

std::optional<Measured> measured(const Result& result, const std::string& measure) {
  if (const std::string fault = measure_fault(measure); !fault.empty()) throw ResultsError(fault);
  if (measure == "error.jump") return of_jump(result);
  if (const auto metric = after(measure, "error.")) return of_error(result, *metric);
  if (measure == "instructions") return instructions(result);
  if (!result.metrics) return std::nullopt;
  const Metrics& metrics = *result.metrics;
  if (measure == "frame_wall") return of_samples(metrics.frame_wall);
  if (measure == "frame_cpu") return of_samples(metrics.frame_cpu);
  if (measure == "prepare.wall") return plain(metrics.prepare.wall);
  if (measure == "prepare.cpu") return plain(metrics.prepare.cpu);
  if (const auto bytes = after(measure, "peak_bytes.")) return plain(bytes_of(metrics.peak_bytes, *bytes));
  if (const auto zone = after(measure, "zone.")) {
    const Metric* found = look_up(metrics.zones, *zone);
    return found == nullptr ? std::nullopt : of_samples(*found);
  }
  const double* counter = look_up(metrics.counters, *after(measure, "counter."));
  return counter == nullptr ? std::nullopt : std::optional(plain(*counter));
}

double in_unit(double value, const std::string& unit) {
  if (unit == "frames/s") return 1 / value;
  if (unit == "ms") return value * 1e3;
  if (unit == "KiB") return value / 1024;
  if (unit == "MiB") return value / (1024.0 * 1024.0);
  return value;
}

}  // namespace volumark
