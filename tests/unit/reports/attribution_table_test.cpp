// The terminal's tables of attribution and of pairs say what the results say.
#include "reports/attribution_table.h"

#include <gtest/gtest.h>

#include <limits>

#include "reports/pairs_table.h"

namespace volumark {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

Attribution entry(const std::string& backend) {
  Attribution out;
  out.key = {"e", "cloud", "raycast", backend, {}, ""};
  out.error = 2e-3;
  out.seconds = 0.01;
  out.all_ideal = 1e-3;
  out.bound = 1e-7;
  out.parts = {{"step", "step", 0.5, 0.125, 1.2e-3, 0.64, 0.04, ""},
               {"volume texture and filter", "volume_format", std::string("native"), std::string("r32f"), 1.9e-3,
                0.0975, 0.011, "gl filters R8 textures with 8 bits (256 levels met)"},
               {"table size", "table_size", int64_t{1021}, int64_t{8192}, 2e-3, 0, 0, ""}};
  return out;
}

TEST(AttributionTable, FewCellsShowEveryPart) {
  Results results;
  EXPECT_EQ(attribution_text(results), "");
  results.attribution = {entry("gl")};
  const std::string text = attribution_text(results);
  EXPECT_TRUE(has(text, "step (step 0.5 -> 0.125)")) << text;
  EXPECT_TRUE(has(text, "64.0 %")) << text;
  EXPECT_TRUE(has(text, "40 ms")) << text;
  EXPECT_TRUE(has(text, "without effect: table size")) << text;
  EXPECT_TRUE(has(text, "75.0 %")) << text;  // all of them
  EXPECT_TRUE(has(text, "gl filters R8 textures with 8 bits")) << text;
}

TEST(AttributionTable, ManyCellsShowTheirLargestParts) {
  Results results;
  results.attribution.assign(7, entry("gl"));
  const std::string text = attribution_text(results);
  EXPECT_TRUE(has(text, "step 64 %, volume texture and filter 10 %")) << text;
  EXPECT_FALSE(has(text, "0.5 -> 0.125")) << text;
  EXPECT_TRUE(has(text, "(7 times)")) << text;
}

TEST(AttributionTable, APartThatCouldNotBeDrawnHasNoFigures) {
  Results results;
  results.attribution = {entry("gl")};
  AttributionPart& part = results.attribution[0].parts[0];
  part.error = part.worth = part.seconds = std::numeric_limits<double>::quiet_NaN();
  part.note = "out of memory";
  const std::string text = attribution_text(results);
  EXPECT_FALSE(has(text, "nan")) << text;
  EXPECT_TRUE(has(text, "step: out of memory")) << text;
}

TEST(AttributionTable, FloorsSayWhatHoldsThem) {
  Results results;
  results.attribution = {entry("gl")};
  Convergence row;
  row.key = entry("gl").key;
  row.floor = 8e-4;
  row.floor_reason = "table size (88 % of the squared error)";
  results.convergence = {row};
  EXPECT_TRUE(has(attribution_text(results), "table size (88 % of the squared error)  8.00e-04"));
}

TEST(PairsTable, VerdictsNameTheMethod) {
  Results results;
  EXPECT_EQ(pairs_text(results), "");
  PairRow row;
  row.a = {"e", "cloud", "raycast", "gl", {}, ""};
  row.b = {"e", "cloud", "texture3d_slices", "gl", {}, ""};
  row.error_verdict = "b";
  row.time_verdict = "indistinguishable";
  row.rmse = 1.5e-3;
  results.pairs = {row};
  const std::string text = pairs_text(results);
  EXPECT_TRUE(has(text, "raycast  texture3d_slices  texture3d_slices  indistinguishable")) << text;
  EXPECT_TRUE(has(text, "1.50e-03")) << text;
}

}  // namespace
}  // namespace volumark
