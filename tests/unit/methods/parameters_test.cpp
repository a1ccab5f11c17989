#include "methods/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace volumark {
namespace {

const Number kStep{{"step", "voxels", "distance", 1, 0.25, 8, {8, 1, .25}}};
const Integer kSize{{"size", "nodes", "of the table", 64, 2, 100}};
const Flag kSkip{"skip", "skips", true};
const Choice kOrder{"order", "which way", {"back_to_front", "front_to_back"}, "back_to_front"};
const std::vector<ParameterInfo> kAll = {kStep.info(), kSize.info(), kSkip.info(), kOrder.info()};

std::string message_of(const std::string& name, const nlohmann::json& value) {
  Values values = default_values(kAll);
  const Values before = values;
  try {
    set_value(kAll, values, name, value);
  } catch (const ParameterError& error) {
    EXPECT_EQ(values, before) << "a refused value changes nothing";
    return error.what();
  }
  return "accepted";
}

std::string message_of_text(const std::string& name, const std::string& text) {
  Values values = default_values(kAll);
  try {
    set_value(kAll, values, name, text);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Parameters, DefaultsAreComplete) {
  const Values values = default_values(kAll);
  EXPECT_EQ(values.size(), 4U);
  EXPECT_EQ(kStep(values), 1);
  EXPECT_EQ(kSize(values), 64);
  EXPECT_TRUE(kSkip(values));
  EXPECT_EQ(kOrder(values), "back_to_front");
  EXPECT_EQ(kOrder.index(values), 0U);
  EXPECT_TRUE(kStep.info().quality_axis);
  EXPECT_FALSE(kSize.info().quality_axis);
}

TEST(Parameters, TextIsParsedToTheType) {
  Values values = default_values(kAll);
  set_value(kAll, values, "step", std::string(".5"));
  set_value(kAll, values, "size", std::string("100"));
  set_value(kAll, values, "skip", std::string("false"));
  set_value(kAll, values, "order", std::string("front_to_back"));
  EXPECT_EQ(kStep(values), 0.5);
  EXPECT_EQ(kSize(values), 100);
  EXPECT_FALSE(kSkip(values));
  EXPECT_EQ(kOrder.index(values), 1U);
  EXPECT_EQ(to_string(values.find("step")->second), "0.5");
}

TEST(Parameters, WholeNumbersAreNumbers) {
  Values values = default_values(kAll);
  set_value(kAll, values, "step", nlohmann::json(2));
  set_value(kAll, values, "size", nlohmann::json(4.0));
  EXPECT_EQ(kStep(values), 2.0);
  EXPECT_EQ(kSize(values), 4);
}

TEST(Parameters, UnknownNameNamesTheNearest) {
  EXPECT_THAT(message_of("stp", 1), ::testing::HasSubstr("did you mean \"step\""));
  EXPECT_THAT(message_of_text("oder", "x"), ::testing::HasSubstr("did you mean \"order\""));
  EXPECT_THAT(message_of("zzzzzz", 1), ::testing::HasSubstr("step, size, skip, order"));
}

TEST(Parameters, RangesAreInclusive) {
  EXPECT_EQ(message_of("step", 0.25), "accepted");
  EXPECT_EQ(message_of("step", 8), "accepted");
  EXPECT_THAT(message_of("step", 8.0001), ::testing::HasSubstr("0.25 to 8 voxels"));
  EXPECT_THAT(message_of("step", std::nan("")), ::testing::HasSubstr("out of range"));
  EXPECT_THAT(message_of("size", 1), ::testing::HasSubstr("out of range"));
  EXPECT_THAT(message_of("size", 101), ::testing::HasSubstr("out of range"));
}

TEST(Parameters, WrongTypesAreRefused) {
  EXPECT_THAT(message_of("step", "1"), ::testing::HasSubstr("a number"));
  EXPECT_THAT(message_of("size", 2.5), ::testing::HasSubstr("a whole number"));
  EXPECT_THAT(message_of("size", 1e300), ::testing::HasSubstr("a whole number"));
  EXPECT_THAT(message_of("skip", 1), ::testing::HasSubstr("true or false"));
  EXPECT_THAT(message_of("order", 3), ::testing::HasSubstr("one of its choices"));
  EXPECT_THAT(message_of("order", "front"), ::testing::HasSubstr("back_to_front, front_to_back"));
  for (const char* text : {"", "one", "1,5", "1 2", "nan", "0x10", "\xff\xfe", "1e999"}) {
    EXPECT_NE(message_of_text("step", text), "accepted") << text;
  }
}

TEST(Parameters, ReadingWithoutAValueIsAnError) {
  EXPECT_THROW(kStep(Values{}), ParameterError);
  EXPECT_THROW(kStep(Values{{"step", std::string("1")}}), ParameterError);
}

}  // namespace
}  // namespace volumark
