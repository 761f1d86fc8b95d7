// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/stamp_guess.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace odosplat {
namespace {

using testing::HasSubstr;

// Time stamps of a recording of `seconds`, from `start` on, `rate` stamps per second, in units of 1 / `per_second` s.
std::vector<double> recording(double rate, double per_second = 1.0, double start = 1305031102.175,
                              double seconds = 10.0) {
  std::vector<double> times;
  for (int k = 0; k < static_cast<int>(seconds * rate); ++k) times.push_back(per_second * (start + k / rate));
  return times;
}

std::string guess(std::vector<double> a, std::vector<double> b) {
  return guess_stamp_fault({"the estimate", std::move(a)}, {"the truth", std::move(b)}, 0.01);
}

TEST(StampGuess, NamesTheUnit) {
  const struct {
    const char* name;
    double per_second;
  } units[] = {{"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}};
  for (const double start : {0.0, 1305031102.175}) {
    for (const auto& unit : units) {
      EXPECT_EQ(guess(recording(30, unit.per_second, start), recording(100, 1, start)),
                std::string("the stamps of the estimate look like ") + unit.name);
      EXPECT_EQ(guess(recording(30, 1, start), recording(100, unit.per_second, start)),
                std::string("the stamps of the truth look like ") + unit.name);
      EXPECT_EQ(guess(recording(2, unit.per_second, start), recording(30, 1, start)),
                std::string("the stamps of the estimate look like ") + unit.name)
          << "keyframes";
    }
    EXPECT_EQ(guess(recording(30, 1e9, start + 0.003), recording(100, 1e9, start)),
              "the stamps of the estimate look like ns, those of the truth like ns");
    EXPECT_EQ(guess(recording(30, 1e3, start), recording(30, 1e9, start)),
              "the stamps of the estimate look like ms, those of the truth like ns");
  }
  // Different start times: the unit follows from the duration.
  EXPECT_EQ(guess(recording(30, 1e9, 0), recording(30)), "the stamps of the estimate look like ns");
}

TEST(StampGuess, NamesAConstantOffset) {
  EXPECT_THAT(guess(recording(30, 1, 0.0), recording(30)),
              HasSubstr("a constant offset of about -1305031102 s lies between the estimate and the truth"));
  EXPECT_THAT(guess(recording(5, 1, 100.5), recording(5, 1, 98.44)), HasSubstr("a constant offset of about 2.060 s"));
  EXPECT_THAT(
      guess(recording(30, 1, 0.0, 3.0), recording(7, 1, 500.0)),
      HasSubstr("the estimate begins at 0.000 s, the truth at 500.000 s: a constant offset of about -500.000 s"));
}

TEST(StampGuess, TellsFrameNumbersFromTimes) {
  std::vector<double> numbers;
  for (int k = 1; k <= 300; ++k) numbers.push_back(k);
  EXPECT_EQ(guess(recording(30, 1, 0.0), numbers), "the stamps of the truth look like frame numbers");
}

TEST(StampGuess, OtherwiseSaysHowFarTheNearestAreApart) {
  std::vector<double> swaying;
  for (int k = 0; k < 100; ++k) swaying.push_back(0.1 * k + 0.03 + 0.02 * (k % 3));
  EXPECT_THAT(guess(swaying, recording(10, 1, 0.0)), HasSubstr("the nearest stamps are 0.030 s apart (median)"));
  EXPECT_EQ(guess({}, recording(10)), "");
}

TEST(StampGuess, UnitOfImagesThatAreFarApart) {
  EXPECT_EQ(unit_of_step(1.0 / 30.0), "");
  EXPECT_EQ(unit_of_step(1.0), "");
  EXPECT_EQ(unit_of_step(33.3), "ms");
  EXPECT_EQ(unit_of_step(33333.0), "us");
  EXPECT_EQ(unit_of_step(3.3e7), "ns");
}

}  // namespace
}  // namespace odosplat
