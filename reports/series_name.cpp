#include "reports/series_name.h"

#include <fmt/format.h>

#include <map>
#include <set>

namespace volumark {

std::string series_suffix(const Results& results, const CellKey& key) {
  std::map<std::string, std::map<ParamValue, size_t>> seen;  // parameter -> value -> cells
  std::set<std::string> axes;
  size_t cells = 0;
  for (const Result& other : results.results) {
    if (other.key.experiment != key.experiment || other.key.method != key.method) continue;
    ++cells;
    if (other.quality) axes.insert(other.quality->parameter);
    for (const auto& [name, value] : other.key.params) ++seen[name][value];
  }
  std::string out;
  for (const auto& [name, value] : key.params) {
    const auto found = seen.find(name);
    if (axes.contains(name) || found == seen.end() || found->second.size() < 2) continue;
    const auto count = found->second.find(value);
    if (count != found->second.end() && 2 * count->second > cells) continue;
    out += fmt::format(" {}={}", name, std::visit([](const auto& v) { return fmt::format("{}", v); }, value));
  }
  if (!key.variant.empty()) out += " (" + key.variant + ")";
  return out;
}

}  // namespace volumark
