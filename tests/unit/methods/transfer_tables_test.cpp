#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "methods/volume/volume_resources.h"

namespace volumark {
namespace {

// As transfer() in volume_common.glsl.
glm::dvec4 look_up(const std::vector<float>& table, double s) {
  const size_t nodes = table.size() / 4;
  const double x = std::clamp(s, 0., 1.) * static_cast<double>(nodes - 1);
  const double node = std::min(std::floor(x), static_cast<double>(nodes - 2));
  const auto i = static_cast<size_t>(node) * 4;
  glm::dvec4 value;
  for (int c = 0; c < 4; ++c) {
    const auto k = i + static_cast<size_t>(c);
    value[c] = table[k] + (x - node) * (static_cast<double>(table[k + 4]) - table[k]);
  }
  return value;
}

TransferFunction eight_bit(std::vector<TransferPoint> points) { return {std::move(points), 0, 255}; }

TEST(TransferTable, QuarterLevelsOfEightBitsAreExact) {
  const TransferFunction transfer =
      eight_bit({{10, {0, 0, 0}, 0}, {63.25, {1, .5, .25}, 3}, {64, {0, 1, 0}, .5}, {200.5, {.1, .9, 1}, 7}});
  const auto table = transfer_table(transfer, 1021);
  for (double s = 0; s <= 255; s += 1. / 16) {
    const glm::dvec4 expected = transfer.at(s), found = look_up(table, s / 255);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(found[c], expected[c], 1e-6 * (1 + expected[c])) << s;
  }
}

TEST(TransferTable, KinkBetweenNodesErrsByAtMostItsBound) {
  const TransferFunction transfer{{{0, {0, 0, 0}, 0}, {0.3333, {1, 1, 1}, 10}, {0.6, {0, 0, 0}, 0}}, 0, 1};
  const int nodes = 101;
  const auto table = transfer_table(transfer, nodes);
  const double change = 10 / 0.3333 + 10 / (0.6 - 0.3333);  // of slope
  double worst = 0;
  for (int i = 0; i <= 100000; ++i) {
    const double s = i / 100000.;
    worst = std::max(worst, std::abs(look_up(table, s).a - transfer.at(s).a));
  }
  EXPECT_LE(worst, 0.25 * change / (nodes - 1) + 1e-5);
  EXPECT_GT(worst, 0) << "the kink lies between two nodes";
}

TEST(TransferTable, JumpKeepsTheIntegral) {
  for (const double place : {0.5049, 0.5001, 0.5099, 0.505}) {
    const TransferFunction transfer{{{0, {1, 0, 0}, 5}, {place, {1, 0, 0}, 5}, {place, {0, 1, 0}, 1}}, 0, 1};
    const auto table = transfer_table(transfer, 101);
    double sum = 0;
    for (size_t i = 0; i < 101; ++i) sum += table[4 * i + 3] * (i == 0 || i == 100 ? 0.5 : 1) / 100;
    EXPECT_NEAR(sum, 5 * place + (1 - place), 1e-6) << place;
    EXPECT_LE(*std::max_element(table.begin(), table.end()), 5.F);
    EXPECT_GE(*std::min_element(table.begin(), table.end()), 0.F);
  }
}

TEST(TransferTable, JumpOnANodeHasTheSecondValueThere) {
  const TransferFunction transfer = eight_bit({{100, {0, 0, 0}, 0}, {100, {1, 1, 1}, 8}});
  const auto table = transfer_table(transfer, 1021);
  EXPECT_EQ(table[4 * 400 + 3], 8.F);
  EXPECT_EQ(table[4 * 399 + 3], 0.F);
}

// Emitted colour of the segment that a table entry stands for.
glm::dvec4 segment_of(const std::vector<float>& table, int size, int front, int back, double length) {
  const float* texel = table.data() + (back * size + front) * 4;
  const double mean = texel[3];
  const double weight = mean * length > 0 ? -std::expm1(-mean * length) / mean : length;
  return {texel[0] * weight, texel[1] * weight, texel[2] * weight, mean * weight};
}

// Linear extinction and colour: I = Lf (1 - Psi) + Lb (Psi - zeta), Williams and Max 1992.
TEST(PreintegrationTable, LinearSegmentsInClosedForm) {
  struct Case {
    double a, b, psi;
  };
  for (const Case& c : {Case{0, 2, .746824132812}, Case{2, 0, .538079506913}, Case{1, 1, .632120558829}}) {
    // Red is 1 where the segment starts and 0 where it ends, green the reverse.
    const TransferFunction transfer{{{0, {1, 0, 0}, c.a}, {1, {0, 1, 0}, c.b}}, 0, 1};
    const double zeta = std::exp(-(c.a + c.b) / 2);
    for (const int size : {2, 3, 64, 100}) {
      const auto table = preintegration_table(transfer, size, 1);
      const glm::dvec4 forward = segment_of(table, size, 0, size - 1, 1);
      EXPECT_NEAR(forward.r, 1 - c.psi, 3e-7) << size;
      EXPECT_NEAR(forward.g, c.psi - zeta, 3e-7) << size;
      EXPECT_NEAR(forward.a, 1 - zeta, 3e-7) << size;
    }
  }
  // The same segment from the other side: extinction runs from 2 to 0 where the table runs from 0 to 2.
  const TransferFunction transfer{{{0, {1, 0, 0}, 0}, {1, {0, 1, 0}, 2}}, 0, 1};
  const auto table = preintegration_table(transfer, 100, 1);
  EXPECT_NEAR(segment_of(table, 100, 99, 0, 1).g, 1 - .538079506913, 3e-7);
}

// Any entry against 20,000 thin layers, with kinks and a jump inside of intervals, and a large optical depth.
TEST(PreintegrationTable, AgreesWithThinLayers) {
  const TransferFunction transfer{{{0.1, {1, 0.2, 0}, 0},
                                   {0.33, {0.5, 1, 0}, 40},
                                   {0.34, {0.5, 1, 0.3}, 2},
                                   {0.617, {0, 1, 1}, 2},
                                   {0.617, {1, 0, 1}, 9},
                                   {0.9, {1, 1, 1}, 300}},
                                  0,
                                  1};
  const int size = 37;
  const double length = 0.7;
  const auto table = preintegration_table(transfer, size, length);
  for (const auto& [front, back] :
       {std::pair{0, 36}, {36, 0}, {3, 20}, {20, 3}, {11, 13}, {22, 23}, {23, 22}, {30, 35}}) {
    const int layers = 20000;
    glm::dvec3 colour(0);
    double transmitted = 1;
    for (int i = 0; i < layers; ++i) {
      const double s = (front + (back - front) * (i + 0.5) / layers) / (size - 1);
      const glm::dvec4 here = transfer.at(s);
      const double opacity = -std::expm1(-here.a * length / layers);
      colour += glm::dvec3(here) * (transmitted * opacity);
      transmitted *= 1 - opacity;
    }
    const glm::dvec4 found = segment_of(table, size, front, back, length);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], colour[c], 2e-4) << front << " " << back;
    EXPECT_NEAR(found.a, 1 - transmitted, 2e-4) << front << " " << back;
  }
}

TEST(PreintegrationTable, DiagonalIsThePointAndTransparentIsBlack) {
  const TransferFunction transfer{{{0, {1, 1, 1}, 0}, {0.5, {1, 1, 1}, 0}, {1, {.5, .25, 1}, 8}}, 0, 1};
  const auto table = preintegration_table(transfer, 11, 0.1);
  for (int i = 0; i < 11; ++i) {
    const glm::dvec4 point = transfer.at(i / 10.);
    const float* texel = table.data() + (i * 11 + i) * 4;
    EXPECT_NEAR(texel[3], point.a, 1e-6);
    EXPECT_NEAR(texel[0], point.r * point.a, 1e-6);
  }
  for (int i = 0; i <= 5; ++i) {
    for (int j = 0; j <= 5; ++j) {
      for (int c = 0; c < 4; ++c) EXPECT_EQ(table[static_cast<size_t>((i * 11 + j) * 4 + c)], 0.F);
    }
  }
  for (const float value : table) EXPECT_TRUE(std::isfinite(value));
}

}  // namespace
}  // namespace volumark
