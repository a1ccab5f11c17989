#include "reports/html/log_axis.h"

#include <algorithm>

namespace volumark::html {

LogAxis::LogAxis(double lo, double hi, double from, double to)
    : lo_(std::log10(lo)), hi_(std::log10(hi)), from_(from), to_(to) {
  const double margin = std::max(0.06 * (hi_ - lo_), 0.04);
  lo_ -= margin;
  hi_ += margin;
  if (hi_ - lo_ < 0.5) {  // a single point, or nearly so
    const double middle = (lo_ + hi_) / 2;
    lo_ = middle - 0.25;
    hi_ = middle + 0.25;
  }
}

double LogAxis::pixel(double value) const {
  const double exponent = value > 0 ? std::clamp(std::log10(value), lo_, hi_) : lo_;
  return from_ + (exponent - lo_) / (hi_ - lo_) * (to_ - from_);
}

std::vector<LogAxis::Tick> LogAxis::ticks() const {
  const double span = hi_ - lo_;
  std::vector<Tick> out;
  for (int e = static_cast<int>(std::floor(lo_)); e <= static_cast<int>(std::ceil(hi_)); ++e)
    for (int digit = 1; digit <= 9; ++digit) {
      const double value = digit * std::pow(10, e);
      if (value < lo() || value > hi()) continue;
      const bool labelled = digit == 1 || (span < 2.6 && (digit == 2 || digit == 5)) ||
                            (span < 1.1 && (digit == 3 || digit == 7)) || (span < .6 && digit != 9);
      out.push_back({value, labelled});
    }
  return out;
}

}  // namespace volumark::html
