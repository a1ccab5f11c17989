#include "harness/bad_news.h"

#include <fmt/format.h>

#include "harness/convergence.h"

namespace volumark {

std::vector<std::string> bad_news_of(const Results& results) {
  std::vector<std::string> out;
  for (const Result& result : results.results)
    if (result.outcome != Outcome::Ok && result.outcome != Outcome::Unsupported)
      out.push_back(fmt::format("{}: {}: {}", to_string(result.outcome), result.command, result.reason));
  for (const ParityRow& row : results.parity)
    if (!row.ok)
      out.push_back(fmt::format("parity: {} {} view {}: {} and {} differ by {:.2e} in {} interior pixels, limit {:g}",
                                row.key.scene, row.key.method, row.view, row.key.backend, row.other, row.interior_max,
                                row.interior_over, row.limit));
  for (const Convergence& row : results.convergence)
    if (is_bad_news(row))
      out.push_back(fmt::format("convergence {}: {} {} {}: {}", row.verdict, row.key.scene, row.key.method,
                                row.key.backend, row.reason));
  for (const SelfTestRow& row : results.self_test)
    if (!row.ok)
      out.push_back(
          fmt::format("metric self test: {}: expected {}, measured {}", row.name, row.expected, row.measured));
  return out;
}

}  // namespace volumark
