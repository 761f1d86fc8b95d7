// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/ticks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace odosplat {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(NiceTicks, AreRoundAndInRange) {
  EXPECT_EQ(nice_ticks(0.0, 10.0, 6), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(nice_ticks(0.0, 20.0, 6), (std::vector<double>{0, 5, 10, 15, 20}));
  for (const double low : {-3.3, 0.0, 0.7, 1e5}) {
    for (const double range : {1e-4, 0.13, 7.0, 9e6}) {
      for (int count = 2; count < 9; ++count) {
        const auto ticks = nice_ticks(low, low + range, count);
        EXPECT_LE(ticks.size(), static_cast<std::size_t>(count));
        EXPECT_GE(ticks.size(), 1U);
        for (const double tick : ticks) {
          EXPECT_GE(tick, low - 1e-6 * range);
          EXPECT_LE(tick, low + range + 1e-6 * range);
        }
        for (std::size_t i = 2; i < ticks.size(); ++i) {
          EXPECT_NEAR(ticks[i] - ticks[i - 1], ticks[1] - ticks[0], 1e-6 * range);
        }
      }
    }
  }
}

TEST(NiceTicks, EmptyOrBrokenRangeGivesOne) {
  EXPECT_EQ(nice_ticks(2.0, 2.0, 5), std::vector<double>{2.0});
  EXPECT_EQ(nice_ticks(2.0, 1.0, 5), std::vector<double>{2.0});
  EXPECT_EQ(nice_ticks(0.0, infinity, 5), std::vector<double>{0.0});
}

TEST(NiceCeiling, IsTheNextRoundNumber) {
  EXPECT_DOUBLE_EQ(nice_ceiling(0.017), 0.02);
  EXPECT_DOUBLE_EQ(nice_ceiling(0.02), 0.02);
  EXPECT_DOUBLE_EQ(nice_ceiling(8.1), 10.0);
  EXPECT_DOUBLE_EQ(nice_ceiling(123.0), 150.0);
  EXPECT_DOUBLE_EQ(nice_ceiling(0.0), 1.0);
  EXPECT_DOUBLE_EQ(nice_ceiling(nan), 1.0);
}

TEST(NiceFloor, IsTheRoundNumberBelow) {
  EXPECT_DOUBLE_EQ(nice_floor(0.017), 0.01);
  EXPECT_DOUBLE_EQ(nice_floor(2.0), 2.0);
  EXPECT_DOUBLE_EQ(nice_floor(700.0), 500.0);
  EXPECT_DOUBLE_EQ(nice_floor(-1.0), 1.0);
}

TEST(TickText, HasJustTheDigitsNeeded) {
  EXPECT_EQ(tick_text(2.0, 1.0), "2");
  EXPECT_EQ(tick_text(2.0, 0.5), "2.0");
  EXPECT_EQ(tick_text(0.25, 0.25), "0.25");
  EXPECT_EQ(tick_text(-1e-15, 0.5), "0.0");
  EXPECT_EQ(tick_text(300.0, 100.0), "300");
}

TEST(LengthText, PicksTheUnit) {
  EXPECT_EQ(length_text(0.0041), "4.1 mm");
  EXPECT_EQ(length_text(0.085), "8.5 cm");
  EXPECT_EQ(length_text(3.7), "3.7 m");
  EXPECT_EQ(length_text(12000.0), "12 km");
  EXPECT_EQ(length_text(2e-5), "20 um");
  EXPECT_EQ(length_text(nan), "-");
  EXPECT_EQ(length_unit(nan).name, "m");
  EXPECT_EQ(length_unit(0.0).name, "m");
}

TEST(ShortNumber, KeepsTwoDigits) {
  EXPECT_EQ(short_number(0.412), "0.41");
  EXPECT_EQ(short_number(4.12), "4.1");
  EXPECT_EQ(short_number(41.2), "41");
  EXPECT_EQ(short_number(412.0), "412");
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(-0.5, 1), "-0.5");
}

}  // namespace
}  // namespace odosplat
