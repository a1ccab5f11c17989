// The terminal's tables say what the results say.
#include "reports/tables.h"

#include <gtest/gtest.h>

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

TEST(Tables, AnEmptyRunHasNoTable) { EXPECT_EQ(tables_text(Results{}), "\nCells:\n"); }

}  // namespace
}  // namespace volumark
