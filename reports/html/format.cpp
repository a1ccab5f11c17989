#include "reports/html/format.h"

#include <fmt/format.h>

#include <cmath>

namespace volumark::html {
namespace {

// "1.20e-03" -> "1.20e-3"
std::string short_exponent(std::string text) {
  const size_t e = text.find('e');
  if (e == std::string::npos) return text;
  size_t digit = e + 2;
  while (digit + 1 < text.size() && text[digit] == '0') text.erase(digit, 1);
  return text;
}

std::string not_finite(double value) {
  if (std::isnan(value)) return "n/a";
  return value > 0 ? "infinite" : "-infinite";
}

}  // namespace

std::string escape(std::string_view text) {
  std::string out;
  out.reserve(text.size());
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
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string json_for_script(std::string json) {
  size_t at = 0;
  while ((at = json.find('<', at)) != std::string::npos) {
    json.replace(at, 1, "\\u003c");
    at += 6;
  }
  return json;
}

std::string number(double value) {
  if (!std::isfinite(value)) return not_finite(value);
  if (value == 0) return "0";
  // Through the rounded text, so that 9.996 has the digits of 10.0.
  const double rounded = std::stod(fmt::format("{:.2e}", value));
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-12));
  if (exponent < -3 || exponent > 5) return scientific(value);
  return fmt::format("{:.{}f}", rounded, std::max(0, 2 - exponent));
}

std::string scientific(double value) {
  if (!std::isfinite(value)) return not_finite(value);
  if (value == 0) return "0";
  return short_exponent(fmt::format("{:.2e}", value));
}

std::string milliseconds(double seconds) { return number(seconds * 1e3); }

std::string compact(double value) {
  if (!std::isfinite(value)) return not_finite(value);
  return short_exponent(fmt::format("{:.6g}", value));
}

std::string power_of_ten(double value) { return short_exponent(fmt::format("{:.0e}", value)); }

std::string to_text(const ParamValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* real = std::get_if<double>(&value)) return compact(*real);
  return std::get<std::string>(value);
}

}  // namespace volumark::html
