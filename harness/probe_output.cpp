#include "harness/probe_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace volumark {
namespace {

using Json = nlohmann::json;

Json json_of(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

Json json_of(const ProbeSample& sample) {
  return {{"transmittance", sample.transmittance}, {"colour", json_of(sample.colour)}, {"bound", sample.bound}};
}

Json json_of(const ProbePoint& point) {
  return {{"depth", point.depth},
          {"value", point.value},
          {"extinction", point.extinction},
          {"colour", json_of(point.colour)}};
}

Json json_of(const ProbeCurve& curve) {
  Json values = Json::object(), samples = Json::array();
  for (const auto& [name, value] : curve.values)
    values[name] = std::visit([](const auto& v) { return Json(v); }, value);
  for (const ProbeSample& sample : curve.samples) samples.push_back(json_of(sample));
  return {{"label", curve.label}, {"method", curve.method}, {"parameters", values}, {"samples", samples}};
}

}  // namespace

std::string curve_letter(size_t index) { return std::string(1, static_cast<char>('A' + index % 26)); }

std::string probe_summary(const Probe& probe, const ProbeHeading& heading) {
  std::string out = fmt::format("{} view {}, pixel {},{} of {}x{}: in the volume from depth {:.6g} to {:.6g}\n",
                                heading.scene, heading.view, probe.options.x, probe.options.y, probe.options.width,
                                probe.options.height, probe.first, probe.last);
  for (size_t i = 0; i < probe.curves.size(); ++i) {
    const ProbeCurve& curve = probe.curves[i];
    out += fmt::format("  {}  {}{}\n", curve_letter(i), curve.label,
                       curve.method == "reference" ? "" : " on " + heading.backend);
  }
  return out;
}

std::string parting_text(const Probe& probe) {
  if (probe.curves.size() < 2) return "one curve alone: nothing to part from";
  const std::string pair = curve_letter(0) + " and " + curve_letter(1);
  if (!probe.parting) {
    double largest = 0;
    for (size_t i = 0; i < probe.ray.size(); ++i)
      largest = std::max(largest, difference_of(probe.curves[0].samples[i], probe.curves[1].samples[i]));
    return fmt::format("{} do not part: nowhere more than {:.3g} apart (threshold {:.3g})", pair, largest,
                       probe.options.threshold);
  }
  const Parting& at = *probe.parting;
  return fmt::format(
      "{} part at depth {:.6g}: T {:.6f} and {:.6f}, {:.3g} apart (threshold {:.3g}); value {:.6g}, extinction {:.6g}, "
      "gradient ({:.4g}, {:.4g}, {:.4g}) of length {:.4g} a world unit",
      pair, at.depth, at.at_a.transmittance, at.at_b.transmittance, difference_of(at.at_a, at.at_b),
      probe.options.threshold, at.point.value, at.point.extinction, at.gradient.x, at.gradient.y, at.gradient.z,
      std::hypot(at.gradient.x, at.gradient.y, at.gradient.z));
}

std::string probe_table(const Probe& probe) {
  std::string out = fmt::format("{:>10} {:>11} {:>11}", "depth", "value", "extinction");
  for (size_t i = 0; i < probe.curves.size(); ++i) {
    const std::string letter = curve_letter(i);
    out += fmt::format(" | {:>8} {:>8} {:>8} {:>8}", "T " + letter, "r " + letter, "g " + letter, "b " + letter);
  }
  out += "\n";
  for (size_t row = 0; row < probe.ray.size(); ++row) {
    const ProbePoint& point = probe.ray[row];
    out += fmt::format("{:>10.6g} {:>11.6g} {:>11.6g}", point.depth, point.value, point.extinction);
    for (const ProbeCurve& curve : probe.curves) {
      const ProbeSample& s = curve.samples[row];
      out += fmt::format(" | {:8.6f} {:8.6f} {:8.6f} {:8.6f}", s.transmittance, s.colour.r, s.colour.g, s.colour.b);
    }
    out += "\n";
  }
  return out;
}

std::string probe_plot(const Probe& probe, int columns, int rows) {
  const auto width = static_cast<size_t>(columns), height = static_cast<size_t>(rows);
  std::vector<std::string> cells(height, std::string(width, ' '));
  const auto column_of = [&](double depth) {
    const double at = (depth - probe.first) / (probe.last - probe.first) * (columns - 1);
    return static_cast<size_t>(std::clamp(std::lround(at), 0L, static_cast<long>(columns - 1)));
  };
  if (probe.parting)
    for (std::string& line : cells) line[column_of(probe.parting->depth)] = ':';
  for (size_t c = 0; c < width; ++c) {
    // The depth nearest to this column, so that a wide plot has no gaps.
    const double place = static_cast<double>(c) / (columns - 1) * (static_cast<double>(probe.ray.size()) - 1);
    const auto row = static_cast<size_t>(std::lround(place));
    for (size_t i = 0; i < probe.curves.size(); ++i) {
      const double transmittance = probe.curves[i].samples[row].transmittance;
      if (!std::isfinite(transmittance)) continue;
      const long from_top = std::lround((1 - std::clamp(transmittance, 0., 1.)) * (rows - 1));
      char& cell = cells[static_cast<size_t>(from_top)][c];
      cell = cell == ' ' || cell == ':' ? curve_letter(i)[0] : '*';
    }
  }
  std::string out = "  T 1 +" + std::string(width, '-') + "+\n";
  for (size_t r = 0; r < height; ++r) out += "      |" + cells[r] + "|\n";
  out += "    0 +" + std::string(width, '-') + "+\n";
  const std::string first = fmt::format("{:.4g}", probe.first), last = fmt::format("{:.4g}", probe.last);
  const int gap = columns - static_cast<int>(first.size() + last.size());
  return out + fmt::format("       {}{:^{}}{}\n       *: several curves in one place{}\n", first, "depth",
                           std::max(gap, 7), last, probe.parting ? "; the dotted line: where they part" : "");
}

std::string probe_json(const Probe& probe, const ProbeHeading& heading) {
  Json ray = Json::array(), curves = Json::array();
  for (const ProbePoint& point : probe.ray) ray.push_back(json_of(point));
  for (const ProbeCurve& curve : probe.curves) curves.push_back(json_of(curve));
  Json out = {{"scene", heading.scene},
              {"view", heading.view},
              {"backend", heading.backend},
              {"command", heading.command},
              {"size", {probe.options.width, probe.options.height}},
              {"pixel", {probe.options.x, probe.options.y}},
              {"threshold", probe.options.threshold},
              {"first", probe.first},
              {"last", probe.last},
              {"ray", ray},
              {"curves", curves},
              {"parting", nullptr}};
  if (probe.parting) {
    const Parting& at = *probe.parting;
    out["parting"] = {{"between", {probe.curves[at.a].label, probe.curves[at.b].label}},
                      {"point", json_of(at.point)},
                      {"gradient", json_of(at.gradient)},
                      {"difference", difference_of(at.at_a, at.at_b)},
                      {"samples", {json_of(at.at_a), json_of(at.at_b)}}};
  }
  return out.dump(1) + "\n";  // what is not finite becomes null
}

}  // namespace volumark
