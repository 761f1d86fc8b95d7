// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/jackknife.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat {
namespace {

TEST(Image, HalveTakesMeansAndDropsOddEnds) {
  const GrayImage image = (GrayImage(3, 5) << 1, 3, 5, 7, 100, 1, 3, 5, 7, 100, 9, 9, 9, 9, 9);
  const GrayImage half = halve(image);
  ASSERT_EQ(half.size(), cv::Size(2, 1));
  EXPECT_FLOAT_EQ(half(0, 0), 2.0F);
  EXPECT_FLOAT_EQ(half(0, 1), 6.0F);
}

TEST(Image, PyramidStopsBeforeNothingIsLeft) {
  EXPECT_EQ(build_pyramid(GrayImage(8, 8, 0.5F), 10).size(), 4U);
  EXPECT_EQ(build_pyramid(GrayImage(8, 8, 0.5F), 2).size(), 2U);
}

TEST(Image, GrayIsLuma601) {
  ColorImage color(1, 3);
  color(0, 0) = {1, 0, 0};
  color(0, 1) = {0, 1, 0};
  color(0, 2) = {0, 0, 1};
  const GrayImage gray = to_gray(color);
  EXPECT_NEAR(gray(0, 0), 0.299, 1e-3);
  EXPECT_NEAR(gray(0, 1), 0.587, 1e-3);
  EXPECT_NEAR(gray(0, 2), 0.114, 1e-3);
}

TEST(Image, BilinearIsExactForLinearImages) {
  GrayImage image(4, 5);
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) image(y, x) = static_cast<float>(2 * x - 3 * y);
  }
  EXPECT_NEAR(bilinear(image, 1.25F, 2.5F), 2 * 1.25 - 3 * 2.5, 1e-6);
  EXPECT_NEAR(bilinear(image, 4.0F, 3.0F), 8 - 9, 1e-6);
  EXPECT_NEAR(bilinear(image, 0.0F, 0.0F), 0, 1e-6);
}

TEST(Random, IsTheSameEverywhere) {
  // First outputs of xoshiro256** seeded by splitmix64(42), computed with an independent script.
  Random random(42);
  EXPECT_EQ(random.next_u64(), 1546998764402558742ULL);
  EXPECT_EQ(random.next_u64(), 6990951692964543102ULL);
}

TEST(Random, MomentsAreRight) {
  Random random(7);
  const int n = 200000;
  double sum = 0;
  double squares = 0;
  double uniform = 0;
  for (int i = 0; i < n; ++i) {
    const double x = random.normal();
    sum += x;
    squares += x * x;
    uniform += random.uniform();
    ASSERT_LT(random.below(7), 7U);
  }
  EXPECT_NEAR(sum / n, 0.0, 0.01);
  EXPECT_NEAR(squares / n, 1.0, 0.02);
  EXPECT_NEAR(uniform / n, 0.5, 0.005);
}

TEST(Jackknife, OfTheMeanIsItsStandardError) {
  // Means of 1, 2, 6 without one of them each; the mean's variance is 7 / 3, that of the values over their number.
  EXPECT_DOUBLE_EQ(jackknife_sigma({4.0, 3.5, 1.5}), std::sqrt(7.0 / 3.0));
  EXPECT_EQ(jackknife_sigma({4.0}), 0.0);
  EXPECT_EQ(jackknife_sigma({}), 0.0);
}

TEST(ParallelFor, CoversEveryElementOnceWhateverTheThreads) {
  for (const int n_threads : {1, 2, 5}) {
    set_threads(n_threads);
    for (const int n : {0, 1, 9, 10, 11, 1000}) {
      std::vector<std::atomic<int>> seen(static_cast<std::size_t>(n));
      parallel_for(n, 10, [&](int begin, int end) {
        EXPECT_EQ(begin % 10, 0);
        for (int i = begin; i < end; ++i) ++seen[static_cast<std::size_t>(i)];
      });
      for (const auto& s : seen) EXPECT_EQ(s, 1);
    }
  }
  set_threads(2);
}

TEST(ParallelFor, RethrowsAndNests) {
  EXPECT_THROW(parallel_for(100, 1, [](int, int) { throw InputError("x"); }), InputError);
  std::atomic<int> count{0};
  parallel_for(4, 1, [&](int, int) { parallel_for(5, 1, [&](int, int) { ++count; }); });
  EXPECT_EQ(count, 20);
  EXPECT_THROW(set_threads(0), InputError);
}

TEST(ParallelFor, GoesOnWithTheThreadsThatTheMachineGives) {
  const auto with_little_memory = [] {
    // Each thread reserves a stack of some megabytes.
    rlimit memory{};
    std::ifstream("/proc/self/statm") >> memory.rlim_cur;
    memory.rlim_cur = memory.rlim_cur * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + (64U << 20U);
    memory.rlim_max = memory.rlim_cur;
    setrlimit(RLIMIT_AS, &memory);
    set_threads(1000);
    std::atomic<int> count{0};
    parallel_for(2000, 1, [&](int, int) {
      ++count;
      usleep(100);
    });
    std::exit(count == 2000 ? 0 : 1);
  };
  EXPECT_EXIT(with_little_memory(), testing::ExitedWithCode(0), "");
}

TEST(StampedPose, KeepsTheStampAsWritten) {
  StampedPose pose;
  pose.time = 1.0 / 3.0;
  EXPECT_EQ(pose.stamp(), "0.333333");
  pose.time_text = "0.3333";
  EXPECT_EQ(pose.stamp(), "0.3333");
}

TEST(Log, UnknownLevelIsRefused) {
  EXPECT_THROW(set_log_level("loud"), InputError);
  EXPECT_NO_THROW(set_log_level("info"));
}

TEST(FormatDuration, ReadsAsAClock) {
  EXPECT_EQ(format_duration(5.4), "0:05");
  EXPECT_EQ(format_duration(3725), "1:02:05");
}

}  // namespace
}  // namespace odosplat
