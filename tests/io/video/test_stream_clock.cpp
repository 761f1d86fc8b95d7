// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/stream_clock.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

constexpr double step = 1.0 / 30.0;

TEST(StreamClock, TakesTheLeastDelayAndKeepsIntervals) {
  StreamClock clock;
  // The first images come late and all at once, as a network stream's do when it is opened.
  double now = 100.0;
  for (int k = 0; k < 30; ++k) clock.time_of(5.0 + step * k, now += 0.001);
  clock.settle();
  const double offset = now - (5.0 + step * 29);
  double before = clock.time_of(5.0 + step * 30, now + step);
  EXPECT_NEAR(before, 5.0 + step * 30 + offset, 2e-6);
  // From here on arrivals vary, and intervals do not.
  for (int k = 31; k < 600; ++k) {
    const double late = 0.02 * (1.0 + std::sin(7.0 * k));
    const double time = clock.time_of(5.0 + step * k, now + step * (k - 29) + late);
    EXPECT_NEAR(time - before, step, 0.005 * step + 2e-6) << k;
    before = time;
  }
}

TEST(StreamClock, FollowsACameraWhoseClockDrifts) {
  StreamClock clock;
  clock.time_of(0.0, 50.0);
  clock.settle();
  double stamp = 0.0;
  double now = 50.0;
  double time = 0.0;
  for (int k = 1; k < 30 * 3600; ++k) {
    stamp += step;
    now += step * 1.0005;  // 1.8 s per hour
    time = clock.time_of(stamp, now + 0.003 * (k % 3));
  }
  EXPECT_NEAR(time, now, 0.02);
}

TEST(StreamClock, WithoutStampsIsTheArrival) {
  StreamClock clock;
  EXPECT_DOUBLE_EQ(clock.time_of(std::nullopt, 3.25), 3.25);
  EXPECT_DOUBLE_EQ(clock.time_of(std::nullopt, 3.5), 3.5);
  EXPECT_DOUBLE_EQ(clock.time_of(std::nullopt, 3.5), 3.500001);  // increases always
}

TEST(StreamClock, StartsAnewWhereStampsJump) {
  StreamClock clock;
  clock.time_of(1000.0, 10.0);
  clock.settle();
  EXPECT_NEAR(clock.time_of(1000.1, 10.1), 10.1, 2e-6);
  EXPECT_NEAR(clock.time_of(0.0, 10.2), 10.2, 2e-6);     // back
  EXPECT_NEAR(clock.time_of(0.1, 10.31), 10.3, 1e-3);    // and on from there
  EXPECT_NEAR(clock.time_of(5000.0, 10.4), 10.4, 2e-6);  // ahead
  EXPECT_NEAR(clock.time_of(5060.0, 70.5), 70.4, 0.5);   // a pause is no jump
  clock.restart();
  EXPECT_NEAR(clock.time_of(5000.5, 80.0), 80.0, 2e-6);
  EXPECT_DOUBLE_EQ(clock.ahead(), 0.0);
}

TEST(StreamClock, TimesIncreaseAndAreMicroseconds) {
  StreamClock clock;
  double last = -1.0;
  double now = 7.0;
  for (int k = 0; k < 5000; ++k) {
    // Stamps that repeat, go back, jump and are missing.
    const double unit = std::fmod(0.618034 * k * k, 1.0);
    std::optional<double> stamp;
    if (k % 7 != 0) stamp = k % 50 == 0 ? 100.0 * unit : 0.03 * (k / 2);
    now += 0.02 * unit;
    const double time = clock.time_of(stamp, now);
    EXPECT_GT(time, last) << k;
    EXPECT_DOUBLE_EQ(time, std::round(time * 1e6) / 1e6) << k;
    if (k == 100) clock.settle();
    last = time;
  }
}

TEST(StreamClock, TellsHowFarImagesComeAheadOfTheirStamps) {
  StreamClock clock;
  clock.time_of(0.0, 10.0);
  clock.settle();
  for (int k = 1; k <= 300; ++k) clock.time_of(step * k, 10.0 + 0.001 * k);
  EXPECT_GT(clock.ahead(), 9.0);
}

}  // namespace
}  // namespace odosplat
