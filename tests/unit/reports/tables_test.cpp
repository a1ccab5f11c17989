// The terminal's tables say what the results say.
#include "reports/tables.h"

#include <gtest/gtest.h>

#include "reports/series_name.h"
#include "tests/unit/reports/sample_results.h"

namespace volumark {
namespace {

TEST(SecondsText, ThreeDigitsAndTheRightUnit) {
  EXPECT_EQ(seconds_text(0.01234), "12.3 ms");
  EXPECT_EQ(seconds_text(2.5e-6), "2.5 us");
  EXPECT_EQ(seconds_text(3), "3 s");
}

TEST(Tables, TimesErrorsAndBadNewsAreThere) {
  const std::string text = tables_text(sample_results());
  EXPECT_NE(text.find("sphere  raycast  cpu*"), std::string::npos) << text;
  EXPECT_NE(text.find("<20 ms"), std::string::npos) << text;   // RMSE 0.01 in the one cell that there is
  EXPECT_NE(text.find("1.0e-02"), std::string::npos) << text;  // its best
  EXPECT_NE(text.find("pass"), std::string::npos) << text;
  EXPECT_NE(text.find("1 ok 1 unsupported"), std::string::npos) << text;
  EXPECT_NE(text.find("unsupported: no compute"), std::string::npos) << text;
  EXPECT_NE(text.find("cpu and gl differ"), std::string::npos) << text;
  EXPECT_NE(text.find("1 of 1 check values"), std::string::npos) << text;
}

TEST(Tables, TimeToErrorSaysBetweenWhichSettings) {
  Results results = sample_results();
  Result fine = results.results[0];
  fine.quality->value = 0.25;
  fine.key.params["step"] = 0.25;
  fine.metrics->frame_wall.stats.median = 0.08;
  fine.error->worst.rmse = fine.views[0].error->rmse = 1e-4;
  results.results[0].error->worst.flip_p99 = 0.2;
  fine.error->worst.flip_p99 = 0.05;
  results.results.push_back(fine);
  const std::string text = tables_text(results);
  EXPECT_NE(text.find("rmse 0.0003"), std::string::npos) << text;
  EXPECT_NE(text.find("40 ms (0.5..0.25)"), std::string::npos) << text;  // 1e-3: half way between 20 and 80 ms
  EXPECT_NE(text.find("<20 ms (0.5)"), std::string::npos) << text;       // 1e-2: measured
  EXPECT_NE(text.find("flip 0.05"), std::string::npos) << text;
  EXPECT_NE(text.find("<80 ms (0.25)"), std::string::npos) << text;  // reached exactly
  EXPECT_EQ(text.find("show nothing"), std::string::npos) << text;
  results.results[0].views[0].shows_nothing = true;
  EXPECT_NE(tables_text(results).find("cells with such views: 1"), std::string::npos);
}

TEST(Tables, WithoutAReferenceTheTimesAreThere) {
  Results results = sample_results();
  EXPECT_EQ(tables_text(results).find("without a reference"), std::string::npos);
  results.results[0].error.reset();
  results.results[0].views[0].error.reset();
  const std::string text = tables_text(results);
  EXPECT_NE(text.find("without a reference"), std::string::npos) << text;
  EXPECT_NE(text.find("step=0.5  20 ms  15 ms..25 ms"), std::string::npos) << text;
}

TEST(SeriesSuffix, NamesWhatIsUnusual) {
  Results results = sample_results();
  results.results.resize(1);
  for (const char* mode : {"post", "post", "pre"}) {
    results.results.push_back(results.results[0]);
    results.results.back().key.params["mode"] = std::string(mode);
    results.results.back().key.params["step"] = static_cast<double>(results.results.size());
  }
  EXPECT_EQ(series_suffix(results, results.results[0].key), "");
  EXPECT_EQ(series_suffix(results, results.results[3].key), " mode=pre");
  results.results.erase(results.results.begin());
  results.results.erase(results.results.begin());  // one of each: neither is the usual one
  EXPECT_EQ(series_suffix(results, results.results[0].key), " mode=post");
  results.results[0].key.variant = "none";
  EXPECT_EQ(series_suffix(results, results.results[0].key), " mode=post (none)");
}

TEST(Tables, AnEmptyRunHasNoTable) { EXPECT_EQ(tables_text(Results{}), "\nCells:\n"); }

}  // namespace
}  // namespace volumark
