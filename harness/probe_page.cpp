// The picture of a ray profile: SVG, and a page around it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "harness/probe_output.h"

namespace volumark {
namespace {

constexpr double kWidth = 760, kLeft = 70, kRight = 20, kPanel = 170, kGap = 42, kTop = 30;
constexpr double kLeast = -7, kMost = 0;  // of log10 of a difference

constexpr const char* kStyle =
    "svg{font:13px sans-serif;color-scheme:light dark}"
    "svg text{fill:currentColor}.frame{fill:none;stroke:currentColor;opacity:.6}"
    ".grid{stroke:currentColor;opacity:.15}.parting{stroke:#c33;stroke-width:1.5;stroke-dasharray:2 3}"
    ".limit{stroke:currentColor;stroke-dasharray:6 4;opacity:.7}"
    ".curve{fill:none;stroke-width:2}.s0{stroke:#0072b2}.s1{stroke:#d55e00;stroke-dasharray:9 4}"
    ".s2{stroke:#009e73;stroke-dasharray:2 3}.s3{stroke:#cc79a7;stroke-dasharray:12 4 2 4}";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

// One panel over depth: values in [lo, hi] from bottom to top.
struct Panel {
  const Probe& probe;
  double top, lo, hi;

  double x(double depth) const {
    return kLeft + (depth - probe.first) / (probe.last - probe.first) * (kWidth - kLeft - kRight);
  }
  double y(double value) const { return top + kPanel * (1 - (std::clamp(value, lo, hi) - lo) / (hi - lo)); }
};

std::string curve(const Panel& panel, size_t style, const std::function<double(size_t)>& value) {
  std::string points, out;
  const auto close = [&] {
    if (!points.empty()) out += fmt::format("<polyline class=\"curve s{}\" points=\"{}\"/>", style % 4, points);
    points.clear();
  };
  for (size_t i = 0; i < panel.probe.ray.size(); ++i) {
    const double v = value(i);
    if (std::isnan(v)) {
      close();
    } else {
      points += fmt::format("{:.1f},{:.1f} ", panel.x(panel.probe.ray[i].depth), panel.y(v));
    }
  }
  close();
  return out;
}

std::string frame(const Panel& panel, const std::string& title,
                  const std::vector<std::pair<double, std::string>>& ticks) {
  std::string out = fmt::format("<text x=\"{}\" y=\"{:.1f}\">{}</text>", kLeft, panel.top - 8, escaped(title));
  for (const auto& [value, label] : ticks) {
    out += fmt::format("<line class=\"grid\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", kLeft, kWidth - kRight,
                       panel.y(value), panel.y(value));
    out +=
        fmt::format("<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", kLeft - 6, panel.y(value) + 4, label);
  }
  if (panel.probe.parting) {
    const double x = panel.x(panel.probe.parting->depth);
    out += fmt::format("<line class=\"parting\" x1=\"{:.1f}\" x2=\"{:.1f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", x, x,
                       panel.top, panel.top + kPanel);
  }
  return out + fmt::format("<rect class=\"frame\" x=\"{}\" y=\"{:.1f}\" width=\"{}\" height=\"{}\"/>", kLeft, panel.top,
                           kWidth - kLeft - kRight, kPanel);
}

// A line's look and what it stands for, in a row at the height `y`.
std::string legend(const std::vector<std::string>& entries, double y) {
  std::string out;
  double x = kLeft;
  for (size_t i = 0; i < entries.size(); ++i) {
    out += fmt::format("<line class=\"curve s{}\" x1=\"{:.0f}\" x2=\"{:.0f}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/>", i % 4, x,
                       x + 34, y, y);
    out += fmt::format("<text x=\"{:.0f}\" y=\"{:.1f}\">{}</text>", x + 40, y + 4, escaped(entries[i]));
    x += 60 + 7.2 * static_cast<double>(entries[i].size());
  }
  return out;
}

std::string transmittance_panel(const Probe& probe, double top) {
  const Panel panel{probe, top, 0, 1};
  std::string out = frame(panel, "Transmittance T(d) of what lies nearer than d", {{0, "0"}, {.5, "0.5"}, {1, "1"}});
  std::vector<std::string> entries;
  for (size_t i = 0; i < probe.curves.size(); ++i) {
    out += curve(panel, i, [&](size_t k) { return probe.curves[i].samples[k].transmittance; });
    entries.push_back(curve_letter(i) + " " + probe.curves[i].label);
  }
  return out + legend(entries, top + kPanel + 14);
}

std::string difference_panel(const Probe& probe, double top) {
  const Panel panel{probe, top, kLeast, kMost};
  std::vector<std::pair<double, std::string>> ticks;
  for (int exponent = static_cast<int>(kLeast); exponent <= static_cast<int>(kMost); ++exponent)
    ticks.emplace_back(exponent, exponent == 0 ? "1" : fmt::format("1e{}", exponent));
  std::string out = frame(panel, "Largest difference of T or a channel", ticks);
  const double limit = panel.y(std::log10(probe.options.threshold));
  out += fmt::format(
      "<line class=\"limit\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"><title>threshold</title></line>", kLeft,
      kWidth - kRight, limit, limit);
  std::vector<std::string> entries;
  for (size_t a = 0; a < probe.curves.size(); ++a) {
    for (size_t b = a + 1; b < probe.curves.size(); ++b) {
      out += curve(panel, entries.size(), [&](size_t k) {
        const double difference = difference_of(probe.curves[a].samples[k], probe.curves[b].samples[k]);
        return difference > 0 ? std::log10(difference) : std::isnan(difference) ? difference : kLeast;
      });
      entries.push_back(fmt::format("{} - {}", curve_letter(a), curve_letter(b)));
    }
  }
  return out + legend(entries, top + kPanel + 14);
}

std::string extinction_panel(const Probe& probe, double top) {
  double most = 0;
  for (const ProbePoint& point : probe.ray) most = std::max(most, point.extinction);
  const Panel panel{probe, top, 0, most > 0 ? most : 1};
  std::string out =
      frame(panel, "Extinction along the ray, 1 / world unit", {{0, "0"}, {panel.hi, fmt::format("{:.3g}", panel.hi)}});
  out += curve(panel, 0, [&](size_t k) { return probe.ray[k].extinction; });
  for (const double share : {0., .25, .5, .75, 1.}) {
    const double depth = probe.first + share * (probe.last - probe.first);
    out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{:.4g}</text>", panel.x(depth),
                       top + kPanel + 18, depth);
  }
  return out + fmt::format(
                   "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">depth d along the view direction, "
                   "world units</text>",
                   (kLeft + kWidth - kRight) / 2, top + kPanel + 36);
}

}  // namespace

std::string probe_svg(const Probe& probe, const ProbeHeading& heading) {
  const bool several = probe.curves.size() > 1;
  const double step = kPanel + kGap + 14, height = kTop + (several ? 3 : 2) * step + 10;
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" role=\"img\" "
      "aria-label=\"{}\"><style>{}</style>",
      kWidth, height, kWidth, height, escaped(probe_summary(probe, heading) + parting_text(probe)), kStyle);
  out += transmittance_panel(probe, kTop);
  if (several) out += difference_panel(probe, kTop + step);
  return out + extinction_panel(probe, kTop + (several ? 2 : 1) * step) + "</svg>\n";
}

std::string probe_html(const Probe& probe, const ProbeHeading& heading) {
  std::string table = "<table><tr><th>depth<th>value<th>extinction";
  for (size_t i = 0; i < probe.curves.size(); ++i)
    for (const char* column : {"T", "r", "g", "b"}) table += fmt::format("<th>{} {}", column, curve_letter(i));
  for (size_t k = 0; k < probe.ray.size(); ++k) {
    const ProbePoint& point = probe.ray[k];
    table += fmt::format("\n<tr><td>{:.6g}<td>{:.6g}<td>{:.6g}", point.depth, point.value, point.extinction);
    for (const ProbeCurve& c : probe.curves) {
      const ProbeSample& s = c.samples[k];
      table +=
          fmt::format("<td>{:.6f}<td>{:.6f}<td>{:.6f}<td>{:.6f}", s.transmittance, s.colour.r, s.colour.g, s.colour.b);
    }
  }
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Ray profile: {0}</title>\n"
      "<style>:root{{color-scheme:light dark}}body{{font:15px/1.5 sans-serif;max-width:60rem;margin:2rem auto;"
      "padding:0 1rem}}svg{{max-width:100%;height:auto}}td,th{{padding:.1em .6em;text-align:right;"
      "font-variant-numeric:tabular-nums}}pre{{white-space:pre-wrap}}</style>\n"
      "<h1>Ray profile: {0}</h1>\n<pre>{1}</pre>\n<p>{2}.</p>\n{3}\n"
      "<p>Again: <code>{4}</code></p>\n<details><summary>Table</summary>\n{5}\n</table></details>\n</html>\n",
      escaped(heading.scene), escaped(probe_summary(probe, heading)), escaped(parting_text(probe)),
      probe_svg(probe, heading), escaped(heading.command), table);
}

}  // namespace volumark
