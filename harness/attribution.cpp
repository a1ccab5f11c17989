#include "harness/attribution.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>
#include <stdexcept>

#include "harness/filter_levels.h"
#include "harness/frame.h"
#include "harness/metrics/metrics.h"
#include "harness/statistics.h"

namespace volumark {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kWorthNaming = 0.05;  // share of the squared error
// RMSE of pictures in [0, 1] that rounding of floats alone explains; smaller steps then only add roundings.
constexpr double kRounding = 8 * static_cast<double>(std::numeric_limits<float>::epsilon());
constexpr int kSamples = 3;
constexpr double kSampleBudget = 0.15;  // seconds; one sample at least

// One setting in the view of the attribution.
struct Measured {
  double error = kNan, seconds = kNan;
  std::string why_not;  // there are no figures
};

const ViewResult* view_of(const Result& result, int64_t index) {
  const auto found = std::find_if(result.views.begin(), result.views.end(),
                                  [index](const ViewResult& view) { return view.index == index; });
  return found == result.views.end() ? nullptr : &*found;
}

const ViewResult& worst_view(const Result& result) {
  const ViewResult* worst = nullptr;
  for (const ViewResult& view : result.views)
    if (view.error && !view.shows_nothing && (worst == nullptr || view.error->rmse > worst->error->rmse)) worst = &view;
  if (worst == nullptr) throw std::invalid_argument("attribution of a cell without an error");
  return *worst;
}

class Attributor {
 public:
  Attributor(const PlannedCell& planned, const SceneContext& context, const CellOptions& options,
             const Results& results)
      : planned_(planned),
        context_(context),
        options_(options),
        results_(results),
        result_(*find_result(results, planned.cell->key)),
        view_(worst_view(result_)) {}

  Attribution run();

 private:
  AttributionPart part(const ParameterInfo& parameter);
  Measured measure(const Values& values);
  std::optional<Measured> measured_before(const Values& values) const;
  Measured draw(const Values& values);
  void check_limits(const Instant& start) const;
  std::string named_cause(const AttributionPart& part, bool quality_axis) const;

  const PlannedCell& planned_;
  const SceneContext& context_;
  const CellOptions& options_;
  const Results& results_;
  const Result& result_;
  const ViewResult& view_;
  std::optional<Device> device_;
};

double number_of(const Value& value) {
  if (const auto* whole = std::get_if<int64_t>(&value)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&value);
  return real == nullptr ? 0 : *real;
}

// Along the quality axis also what is finer than the ideal: going back to it would show the error of the coarser work.
bool is_ideal(const ParameterInfo& parameter, const Value& value) {
  if (value == *parameter.ideal) return true;
  if (!parameter.quality_axis) return false;
  const bool falling = parameter.sweep.front() > parameter.sweep.back();
  return falling ? number_of(value) < number_of(*parameter.ideal) : number_of(value) > number_of(*parameter.ideal);
}

Attribution Attributor::run() {
  Attribution out;
  out.key = result_.key;
  out.error = view_.error->rmse;
  out.seconds = view_.frame_wall ? view_.frame_wall->median : 0;
  out.bound = view_.reference->bound;
  out.command = result_.command;
  out.all_ideal = out.error;
  if (out.error <= out.bound) {
    out.note = "the error is below the reference's bound: nothing can be told apart there";
    return out;
  }
  if (out.error <= kRounding) {
    out.note = "the error is rounding of single precision: nothing can be told apart there";
    return out;
  }
  Values all = planned_.group->values;
  for (const ParameterInfo& parameter : planned_.group->method->info().parameters) {
    if (!parameter.ideal || is_ideal(parameter, planned_.group->values.at(parameter.name))) continue;
    all[parameter.name] = *parameter.ideal;
    out.parts.push_back(part(parameter));
  }
  if (out.parts.size() == 1) {
    out.all_ideal = out.parts.front().error;
  } else if (!out.parts.empty()) {
    const Measured ideal = measure(all);
    out.all_ideal = ideal.error;
    if (!ideal.why_not.empty()) out.note = "with all parts ideal: " + ideal.why_not;
  }
  std::stable_sort(out.parts.begin(), out.parts.end(), [](const auto& a, const auto& b) {
    return !std::isnan(a.worth) && (std::isnan(b.worth) || a.worth > b.worth);
  });
  return out;
}

AttributionPart Attributor::part(const ParameterInfo& parameter) {
  Values values = planned_.group->values;
  AttributionPart out;
  out.aspect = parameter.aspect;
  out.parameter = parameter.name;
  out.from = values.at(parameter.name);
  out.to = *parameter.ideal;
  values[parameter.name] = *parameter.ideal;
  const Measured measured = measure(values);
  const double error = view_.error->rmse;
  out.error = measured.error;
  out.worth = 1 - (measured.error * measured.error) / (error * error);
  out.seconds = measured.seconds;
  out.note = measured.why_not.empty() ? named_cause(out, parameter.quality_axis) : measured.why_not;
  return out;
}

Measured Attributor::measure(const Values& values) {
  if (const auto before = measured_before(values)) return *before;
  Measured out;
  try {
    return draw(values);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    out.why_not = "out of memory";
  } catch (const std::exception& error) {
    out.why_not = error.what();
  }
  device_.reset();  // whatever state it is in
  return out;
}

// A cell of the run that has this setting: its picture is not drawn again.
std::optional<Measured> Attributor::measured_before(const Values& values) const {
  CellKey key = result_.key;
  key.params = values;
  const Result* result = find_result(results_, key);
  if (result == nullptr || !result->error) return std::nullopt;
  const ViewResult* view = view_of(*result, view_.index);
  if (view == nullptr || !view->error || !view->frame_wall) return std::nullopt;
  return Measured{view->error->rmse, view->frame_wall->median, ""};
}

void Attributor::check_limits(const Instant& start) const {
  if (options_.stop != nullptr && options_.stop->load()) throw Interrupted{};
  const double limit = planned_.group->experiment->timeout;
  if (since(start).wall > limit) throw std::runtime_error(fmt::format("timeout: more than {:g} s", limit));
}

Measured Attributor::draw(const Values& values) {
  const Instant start = now();
  check_limits(start);
  if (!device_) device_.emplace(make_device(planned_.cell->backend, options_.device));
  Measured out;
  if (const auto reason = unsupported_reason(*planned_.group->method, context_.scene, values, device_->info())) {
    out.why_not = "unsupported: " + *reason;
    return out;
  }
  const View& view = context_.scene.views[static_cast<size_t>(view_.index)];
  FrameSource source(context_.scene, *planned_.group->method, values, *device_, context_.width, context_.height);
  check_limits(start);
  source.frame(view);
  CompareOptions compare;
  compare.background = context_.scene.background;
  compare.perceptual = false;
  const Reference& reference = context_.references.at(static_cast<int>(view_.index));
  const Errors errors = compare_images(source.read_back(), reference.image, compare);
  if (errors.non_finite > 0) {
    out.why_not = fmt::format("{} pixels are NaN or infinite", errors.non_finite);
    return out;
  }
  out.error = errors.rmse;
  if (out.error == view_.error->rmse) {  // without effect here: what it costs is not worth its time
    out.seconds = 0;
    return out;
  }
  std::vector<double> samples;
  const Instant timed = now();
  do {
    check_limits(start);
    samples.push_back(source.frame(view).cost.wall);
  } while (samples.size() < kSamples && since(timed).wall < kSampleBudget);
  out.seconds = median(samples);
  return out;
}

// What a texture format of the parameters stands for on this data.
std::string texel_format(const ParamValue& value, VoxelType type) {
  const auto* name = std::get_if<std::string>(&value);
  if (name == nullptr) return "";
  if (*name != "native") return *name;
  return type == VoxelType::U8 ? "r8" : type == VoxelType::F32 ? "r32f" : "r16";
}

std::string upper(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

std::string Attributor::named_cause(const AttributionPart& part, bool quality_axis) const {
  if (part.worth < -kWorthNaming)
    return quality_axis ? "the error grew: finer work rounds more often, or two errors had cancelled"
                        : "the error grew: two errors had cancelled";
  if (!(part.worth > kWorthNaming) || part.aspect != "volume texture and filter") return "";
  if (!context_.scene.volume) return "";
  const std::string format = texel_format(part.from, context_.scene.volume->type);
  for (const BackendResultInfo& backend : results_.backends) {
    const auto levels = backend.filter_levels.find(format);
    if (backend.id != planned_.cell->backend || levels == backend.filter_levels.end()) continue;
    if (levels->second <= kCoarseFilterLevels)
      return fmt::format("{} filters {} textures with 8 bits ({:g} levels met)", backend.id, upper(format),
                         levels->second);
  }
  return "";
}

// The finest cell of a series with a floor.
bool ends_series(const Convergence& row, const Result& result) {
  if (!result.quality || result.quality->parameter != row.parameter || row.values.empty()) return false;
  CellKey key = result.key;
  key.params.erase(row.parameter);
  return key == row.key && result.quality->value == row.values.back();
}

const Result* finest_of(const Convergence& row, const Results& results) {
  const auto found = std::find_if(results.results.begin(), results.results.end(),
                                  [&](const Result& result) { return ends_series(row, result); });
  return found == results.results.end() ? nullptr : &*found;
}

const Attribution* attribution_of(const Results& results, const CellKey& key) {
  const auto found = std::find_if(results.attribution.begin(), results.attribution.end(),
                                  [&](const Attribution& entry) { return entry.key == key; });
  return found == results.attribution.end() ? nullptr : &*found;
}

std::string floor_text(const Attribution& entry) {
  if (entry.error <= entry.bound) return "at the reference's bound";
  if (entry.error <= kRounding) return "rounding of single precision";
  std::vector<std::string> causes;
  for (const AttributionPart& part : entry.parts)
    if (part.worth >= kWorthNaming)
      causes.push_back(fmt::format("{} ({:.0f} % of the squared error)", part.aspect, 100 * part.worth));
  if (std::isnan(entry.all_ideal))
    return causes.empty() ? "not known: " + entry.note : fmt::format("{}", fmt::join(causes, ", "));
  const double left = entry.all_ideal * entry.all_ideal / (entry.error * entry.error);
  if (entry.all_ideal <= entry.bound) {
    if (causes.empty()) causes.emplace_back("no part alone, all together");
  } else if (causes.empty() || left >= kWorthNaming) {
    causes.push_back(left < 1 - kWorthNaming || !causes.empty()
                         ? fmt::format("the method's own ({:.0f} %)", 100 * std::min(left, 1.0))
                         : "the method's own");
  }
  return fmt::format("{}", fmt::join(causes, ", "));
}

}  // namespace

Attribution attribute(const PlannedCell& cell, const SceneContext& context, const CellOptions& options,
                      const Results& results) {
  return Attributor(cell, context, options, results).run();
}

std::vector<PlannedCell> cells_to_attribute(std::span<const Group> groups, const Results& results) {
  std::vector<PlannedCell> out = usual_cells(groups, results);
  for (const Group& group : groups)
    for (const Cell& cell : group.cells) {
      if (!cell.key.variant.empty())
        continue;  // effects are switched for their price; errors are of the scene as it is
      const Result* result = find_result(results, cell.key);
      if (result == nullptr || !result->error || !result->metrics) continue;
      const bool floor =
          std::any_of(results.convergence.begin(), results.convergence.end(),
                      [&](const Convergence& row) { return row.floor > 0 && ends_series(row, *result); });
      if (floor && std::none_of(out.begin(), out.end(), [&](const PlannedCell& c) { return c.cell == &cell; }))
        out.push_back({&group, &cell});
    }
  std::erase_if(out, [&](const PlannedCell& c) { return attribution_of(results, c.cell->key) != nullptr; });
  return out;
}

void explain_floors(Results& results) {
  for (Convergence& row : results.convergence) {
    if (!(row.floor > 0)) continue;
    const Result* finest = finest_of(row, results);
    const Attribution* entry = finest == nullptr ? nullptr : attribution_of(results, finest->key);
    if (entry != nullptr) row.floor_reason = floor_text(*entry);
  }
}

}  // namespace volumark
