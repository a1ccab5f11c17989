#include <gtest/gtest.h>

#include "scenes/scene.h"

namespace volumark {
namespace {

TransferFunction with_jump() {
  TransferFunction t;
  t.points = {{1, {1, 0, 0}, 2}, {3, {0, 1, 0}, 4}, {3, {0, 0, 1}, 10}, {5, {1, 1, 1}, 0}};
  return t;
}

TEST(Transfer, LinearBetweenPoints) {
  EXPECT_EQ(with_jump().at(2), glm::dvec4(0.5, 0.5, 0, 3));
  EXPECT_EQ(with_jump().at(4), glm::dvec4(0.5, 0.5, 1, 5));
}

TEST(Transfer, ConstantBeyondTheEnds) {
  EXPECT_EQ(with_jump().at(-100), glm::dvec4(1, 0, 0, 2));
  EXPECT_EQ(with_jump().at(1), glm::dvec4(1, 0, 0, 2));
  EXPECT_EQ(with_jump().at(5), glm::dvec4(1, 1, 1, 0));
  EXPECT_EQ(with_jump().at(1e30), glm::dvec4(1, 1, 1, 0));
}

TEST(Transfer, JumpHasTheSecondValue) {
  EXPECT_EQ(with_jump().at(3), glm::dvec4(0, 0, 1, 10));
  EXPECT_NEAR(with_jump().at(3 - 1e-9).w, 4, 1e-8);
}

TEST(Transfer, JumpAtTheVeryEnds) {
  TransferFunction t;
  t.points = {{0, {0, 0, 0}, 7}, {0, {1, 1, 1}, 5}};
  EXPECT_EQ(t.at(-1).w, 7);
  EXPECT_EQ(t.at(0).w, 5);
  EXPECT_EQ(t.at(1).w, 5);
}

TEST(Transfer, LargestExtinction) { EXPECT_EQ(with_jump().max_extinction(), 10); }

TEST(Effects, NamesOfThoseCalledFor) {
  Effects effects;
  EXPECT_TRUE(effect_names(effects).empty());
  effects.lighting.emplace();
  effects.clip_planes.emplace_back();
  EXPECT_EQ(effect_names(effects), (std::vector<std::string>{"lighting", "clip_planes"}));
}

}  // namespace
}  // namespace volumark
