#include "harness/verify/case_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace volumark {
namespace {

// Of what is not finite in a row: results files hold numbers.
constexpr double kBeyond = std::numeric_limits<double>::max();

double finite(double value) {
  return std::isfinite(value) ? value : std::isnan(value) ? 0 : std::copysign(kBeyond, value);
}

bool accepts(const ParameterInfo& info, const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value))
    return std::find(info.choices.begin(), info.choices.end(), *text) != info.choices.end();
  if (std::holds_alternative<bool>(value)) return std::holds_alternative<bool>(info.default_value);
  const double number =
      std::holds_alternative<double>(value) ? std::get<double>(value) : static_cast<double>(std::get<int64_t>(value));
  return info.choices.empty() && !std::holds_alternative<bool>(info.default_value) && number >= info.lo &&
         number <= info.hi;
}

Value typed_like(const Value& model, const Value& value) {
  if (std::holds_alternative<double>(model) && std::holds_alternative<int64_t>(value))
    return static_cast<double>(std::get<int64_t>(value));
  if (std::holds_alternative<int64_t>(model) && std::holds_alternative<double>(value))
    return static_cast<int64_t>(std::llround(std::get<double>(value)));
  return value;
}

const ParameterInfo* parameter_of(const Method& method, const std::string& name) {
  for (const ParameterInfo& info : method.info().parameters)
    if (info.name == name) return &info;
  return nullptr;
}

// How far a value lies from where it should be, and how far it may: in the direction in which it errs.
struct Judged {
  double deviation, bound;
};
Judged judge(const Allowed& allowed, double measured) {
  if (!std::isfinite(measured)) return {kBeyond, std::max(allowed.hi - allowed.value, allowed.value - allowed.lo)};
  return {std::abs(measured - allowed.value),
          measured >= allowed.value ? allowed.hi - allowed.value : allowed.value - allowed.lo};
}

double share(const Judged& judged) {
  if (judged.deviation == 0) return 0;
  return judged.bound > 0 ? judged.deviation / judged.bound : kBeyond;
}

}  // namespace

bool CaseRun::has(const std::string& parameter, const Value& value) const {
  const ParameterInfo* info = parameter_of(method(), parameter);
  return info != nullptr && accepts(*info, value);
}

Values CaseRun::values(const Settings& settings) const {
  Values out = default_values(method().info().parameters);
  for (const ParameterInfo& info : method().info().parameters)
    if (info.ideal && info.aspect == "early termination") out[info.name] = *info.ideal;
  for (const auto& [name, value] : settings) {
    const ParameterInfo* info = parameter_of(method(), name);
    if (info == nullptr || !accepts(*info, value))
      throw NotApplicable(fmt::format("{} has no {} = {}", method().info().name, name, to_string(value)));
    out[name] = typed_like(info->default_value, value);
  }
  return out;
}

bool CaseRun::steps_exactly() const {
  for (const ParameterInfo& info : method().info().parameters)
    if (info.quality_axis) return info.unit == "voxels";
  return false;
}

Values CaseRun::stepped(double step, Settings settings) const {
  for (const ParameterInfo& info : method().info().parameters)
    if (info.quality_axis && info.unit == "voxels") {
      settings.emplace_back(info.name, step);
      return values(settings);
    } else if (info.quality_axis && info.unit == "percent") {
      settings.emplace_back(info.name, std::round(100 / step));
      return values(settings);
    }
  throw NotApplicable(fmt::format("{} has no step in voxels", method().info().name));
}

Values CaseRun::scene_values(const Scene& scene) const {
  if (!scene.volume) return values({});
  const glm::dvec3 extent = scene.volume->extent(), spacing = scene.volume->spacing;
  const double voxels = glm::length(extent) / std::min({spacing.x, spacing.y, spacing.z});
  const std::vector<ParameterInfo>& all = method().info().parameters;
  const bool steps = std::any_of(all.begin(), all.end(), [](const ParameterInfo& info) { return info.quality_axis; });
  return steps ? stepped(std::max(1.0, voxels / 100)) : values({});
}

std::unique_ptr<FrameSource> CaseRun::prepare(const Scene& scene, const Values& values, int width, int height) {
  return prepare(scene, values, width, height, device());
}

std::unique_ptr<FrameSource> CaseRun::prepare(const Scene& scene, const Values& values, int width, int height,
                                              Device& device) {
  if (const auto why = unsupported_reason(method(), scene, values, device.info())) throw NotApplicable(*why);
  return std::make_unique<FrameSource>(scene, method(), values, device, width, height);
}

Image CaseRun::draw(const Scene& scene, const Values& values, const View& view, int width, int height) {
  const auto source = prepare(scene, values, width, height);
  source->frame(view);
  return source->read_back();
}

HardCaseRow CaseRun::new_row(const std::string& check, const std::string& source) const {
  HardCaseRow row;
  row.id = given_.hard_case->id;
  row.number = given_.hard_case->number;
  row.title = given_.hard_case->title;
  row.check = check;
  row.method = given_.method != nullptr ? given_.method->info().name : "";
  row.backend = given_.device != nullptr ? given_.device->info().id : "";
  row.source = source;
  row.command = given_.command;
  return row;
}

void CaseRun::add_row(HardCaseRow row, const Image* picture, const Image* expected) {
  const auto kept = [](const Image* image) { return image != nullptr ? std::make_shared<Image>(*image) : nullptr; };
  rows_.push_back({std::move(row), kept(picture), kept(expected)});
}

void CaseRun::add(const Check& check) {
  HardCaseRow row = new_row(check.check, check.source);
  const Judged judged = judge(within(check.expected, check.bound), check.measured);
  row.expected = check.expected;
  row.measured = finite(check.measured);
  row.deviation = judged.deviation;
  row.bound = check.bound;
  row.outcome = judged.deviation <= check.bound ? "pass" : "fail";
  if (row.outcome == "fail")
    row.reason =
        fmt::format("{:.9g} where {:.9g} is expected within {:.2g}", check.measured, check.expected, check.bound);
  add_row(std::move(row));
}

void CaseRun::add_worst(const std::string& check, const Image& image, std::shared_ptr<const Image> expected,
                        const std::vector<Allowed>& allowed, const std::string& source) {
  HardCaseRow row = new_row(check, source);
  double worst = -1;
  for (size_t i = 0; i < image.rgba.size(); ++i) {
    const Judged judged = judge(allowed[i], static_cast<double>(image.rgba[i]));
    if (share(judged) <= worst) continue;
    worst = share(judged);
    row.expected = allowed[i].value;
    row.measured = finite(static_cast<double>(image.rgba[i]));
    row.deviation = judged.deviation;
    row.bound = judged.bound;
    row.x = static_cast<int64_t>(i / 4) % image.width;
    row.y = static_cast<int64_t>(i / 4) / image.width;
  }
  row.outcome = row.deviation <= row.bound ? "pass" : "fail";
  if (row.outcome == "fail")
    row.reason = fmt::format("pixel {}, {}: {:.9g} where {:.9g} is expected within {:.2g}", row.x, row.y, row.measured,
                             row.expected, row.bound);
  rows_.push_back({std::move(row), std::make_shared<Image>(image), std::move(expected)});
}

void CaseRun::add_equal(const std::string& check, const Image& image, const Image& expected, double bound,
                        const std::string& source) {
  std::vector<Allowed> allowed;
  allowed.reserve(expected.rgba.size());
  for (const float value : expected.rgba) allowed.push_back(within(static_cast<double>(value), bound));
  add_worst(check, image, std::make_shared<Image>(expected), allowed, source);
}

void CaseRun::not_applicable(const std::string& check, const std::string& reason) {
  HardCaseRow row = new_row(check, "");
  row.outcome = "not_applicable";
  row.reason = reason;
  add_row(std::move(row));
}

void CaseRun::error(const std::string& reason) {
  HardCaseRow row = new_row("the case itself", "");
  row.outcome = "error";
  row.reason = reason;
  row.deviation = kBeyond;
  add_row(std::move(row));
}

}  // namespace volumark
