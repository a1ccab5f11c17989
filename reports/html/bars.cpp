#include "reports/html/bars.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/html/format.h"

namespace volumark::html {
namespace {

constexpr double kNarrow = 0.045;  // of the bar: too narrow for a letter

}  // namespace

std::string bar(double share, size_t pattern, const std::string& words) {
  const double width = std::isfinite(share) ? std::clamp(share, 0.0, 1.0) : 0;
  const std::string fill = width > 0 ? fmt::format("<span class=\"fill p{}\" style=\"width:{:.2f}%\"></span>",
                                                   pattern % kPatterns, 100 * width)
                                     : "";
  return "<span class=\"bar\"><span class=\"track\">" + fill + "</span><span class=\"words\">" + words +
         "</span></span>";
}

std::string bound_bar(double share) {
  const double inside = std::clamp(share, 0.0, 1.0), beyond = std::clamp(share - 1, 0.0, 1.0 / 3);
  return fmt::format(
      "<span class=\"bound-bar{}\" aria-hidden=\"true\"><span class=\"fill p0\" "
      "style=\"width:{:.2f}%\"></span>{}</span>",
      share > 1 ? " over" : "", 75 * (std::isnan(share) ? 0 : inside),
      share > 1 ? fmt::format("<span class=\"fill p1\" style=\"width:{:.2f}%\"></span>", 75 * beyond) : "");
}

std::string swatch(size_t pattern) {
  return fmt::format("<span class=\"swatch fill p{}\" aria-hidden=\"true\"></span>", pattern % kPatterns);
}

std::string stacked_bar(const std::vector<Segment>& segments) {
  double below = 0, above = 0;
  for (const Segment& segment : segments) (segment.share < 0 ? below : above) += std::abs(segment.share);
  const bool cut = below > 1;  // where errors cancel, a part can be worth many times -100 %
  below = std::min(below, 1.0);
  const double whole = below + std::max(above, 1.0);
  auto place = [&](double value) { return 100 * (below + value) / whole; };
  std::string out = "<span class=\"stack\" aria-hidden=\"true\">";
  double right = 0, left = 0;
  for (const Segment& segment : segments) {
    double size = std::abs(segment.share);
    if (segment.share < 0) {
      size = std::min(size, below + left);
      left -= size;
    }
    const double from = segment.share < 0 ? left : right;
    if (segment.share >= 0) right += size;
    if (size <= 0) continue;
    out += fmt::format("<span class=\"fill p{}\" style=\"left:{:.3f}%;width:{:.3f}%\" title=\"{}\">{}</span>",
                       segment.pattern % kPatterns, place(from), 100 * size / whole, escape(segment.title),
                       size / whole > kNarrow ? "<b>" + escape(segment.letter) + "</b>" : "");
  }
  out += fmt::format("<i class=\"at-one\" style=\"left:{:.3f}%\"></i>", place(1));
  if (below > 0) out += fmt::format("<i class=\"at-zero\" style=\"left:{:.3f}%\"></i>", place(0));
  return out + (cut ? "<b class=\"cut\">&#9666;</b>" : "") + "</span>";
}

}  // namespace volumark::html
