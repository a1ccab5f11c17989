// A driver that filters bytes with 8 bits is found by its error, and named.
#include <algorithm>

#include "tests/images/attribution/coarse.h"
#include "tests/unit/harness/tiny_run.h"

namespace volumark {
namespace {

using NamedCause = TinyRun;

TEST_F(NamedCause, EightBitFilteringIsNamedWhereItIsThere) {
  const bool coarse = filters_coarsely();
  Json json = experiment(Json::array({{{"method", "raycast"}, {"set", {{"step", 0.125}}}}}));
  json["backends"] = {backend_id()};
  json["attribute"] = true;
  const RunOutcome outcome = run(json);
  ASSERT_EQ(outcome.results.attribution.size(), 1U);
  ASSERT_EQ(outcome.results.backends.size(), 1U);
  EXPECT_EQ(outcome.results.backends[0].filter_levels.at("r8") <= 300, coarse);
  const auto& parts = outcome.results.attribution[0].parts;
  const auto part =
      std::find_if(parts.begin(), parts.end(), [](const auto& p) { return p.aspect == "volume texture and filter"; });
  ASSERT_NE(part, parts.end());
  if (coarse) {
    EXPECT_EQ(part, parts.begin());
    EXPECT_GT(part->worth, 0.5);
    EXPECT_EQ(part->note, backend_id() + " filters R8 textures with 8 bits (256 levels met)");
  } else {
    EXPECT_LT(part->worth, 0.05);
    EXPECT_EQ(part->note, "");
  }
}

}  // namespace
}  // namespace volumark
