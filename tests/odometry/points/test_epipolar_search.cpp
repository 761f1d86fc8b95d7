// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include "odosplat/core/parallel.hpp"
#include "odosplat/odometry/points/immature_points.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

class EpipolarSearchTest : public testing::Test {
 protected:
  EpipolarSearchTest() {
    gradients_ = build_gradients(build_frame_pyramid(camera_, room_.gray(camera_, T_world_host_)));
    PixelSelector selector({});
    ImmaturePointOptions options;
    options.points = 300;
    points_ = make_immature_points(gradients_, {}, 50.0 / 255, selector, options);
  }

  double true_q(const ImmaturePoint& p) const { return 1.0 / room_.depth(camera_, T_world_host_, p.u, p.v); }

  void trace(const SE3& T_world_target, const Brightness& brightness = {}) {
    GrayImage image = room_.gray(camera_, T_world_target);
    for (float& value : image) {
      value = static_cast<float>(std::exp(brightness.a) * static_cast<double>(value) + brightness.b);
    }
    trace_points(points_, T_world_target.inverse() * T_world_host_, build_frame_pyramid(camera_, image), brightness,
                 {});
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  SE3 T_world_host_{so3_exp({0.05, -0.1, 0.02}), {0.1, -0.05, 0.2}};
  std::vector<GradientImage> gradients_;
  std::vector<ImmaturePoint> points_;
};

TEST_F(EpipolarSearchTest, FindsTheDepthOfTheRoom) {
  ASSERT_GT(points_.size(), 150U);
  // Small steps to the side first, then larger ones: the first limit the intervals, so that repeated waves are not
  // confused later.
  for (const double step : {0.02, 0.05, 0.10, 0.16})
    trace(T_world_host_ * SE3(so3_exp({0.0, 0.0, 0.01}), {step, 0.5 * step, 0.0}));
  int distinct = 0;
  int right = 0;
  for (const ImmaturePoint& p : points_) {
    if (p.found == 0 || p.quality < 3.0) continue;
    ++distinct;
    const double q = 0.5 * (p.min_q + p.max_q);
    if (std::abs(q - true_q(p)) < 0.05 * true_q(p)) ++right;
  }
  EXPECT_GT(distinct, 60);
  EXPECT_GE(right, 0.9 * distinct);
}

TEST_F(EpipolarSearchTest, BrightnessOfTheTargetIsTakenIntoAccount) {
  const SE3 T = T_world_host_ * SE3(so3_exp({0.0, 0.0, 0.0}), {0.08, 0.03, 0.0});
  auto undisturbed = points_;
  trace(T);
  undisturbed.swap(points_);
  trace(T, {0.3, 0.05});
  ASSERT_EQ(points_.size(), undisturbed.size());
  int same = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (std::abs(points_[i].max_q - undisturbed[i].max_q) < 0.02 * undisturbed[i].max_q) ++same;
  }
  EXPECT_GT(same, 0.95 * static_cast<double>(points_.size()));
}

TEST_F(EpipolarSearchTest, WithoutMotionNothingIsLearnt) {
  const auto before = points_;
  trace(T_world_host_ * SE3(so3_exp({0.02, 0.0, 0.0}), {0.0, 0.0, 0.0}));
  ASSERT_EQ(points_.size(), before.size());
  for (std::size_t i = 0; i < points_.size(); ++i) {
    EXPECT_EQ(points_[i].min_q, before[i].min_q);
    EXPECT_EQ(points_[i].max_q, before[i].max_q);
    EXPECT_EQ(points_[i].found, 0);
  }
}

TEST_F(EpipolarSearchTest, PointsThatNothingLooksLikeAreGivenUp) {
  ASSERT_FALSE(points_.empty());
  const GrayImage blank(camera_.height, camera_.width, 0.0F);
  const SE3 T_target_host(so3_exp({0.0, 0.0, 0.0}), {-0.1, -0.05, 0.0});
  for (int i = 0; i < 2; ++i) trace_points(points_, T_target_host, build_frame_pyramid(camera_, blank), {}, {});
  for (const ImmaturePoint& p : points_) EXPECT_EQ(p.found, 0);
  const auto left = std::count_if(points_.begin(), points_.end(),
                                  [](const ImmaturePoint& p) { return p.status == SearchStatus::outlier; });
  EXPECT_EQ(left, 0);
}

TEST_F(EpipolarSearchTest, BehindTheCameraIsOutOfView) {
  const SE3 T_target_host(so3_exp({0.0, 3.14, 0.0}), {0.1, 0.0, 0.0});
  const SearchResult r =
      search_epipolar_line(points_.front(), T_target_host, camera_, room_.gray(camera_, T_world_host_), {}, {});
  EXPECT_EQ(r.status, SearchStatus::out_of_view);
}

TEST_F(EpipolarSearchTest, SameBitsWithAnyNumberOfThreads) {
  const auto start = points_;
  std::vector<std::vector<ImmaturePoint>> results;
  const int before = threads();
  for (const int n : {1, 2, 5}) {
    set_threads(n);
    points_ = start;
    trace(T_world_host_ * SE3(so3_exp({0.0, 0.01, 0.0}), {0.1, 0.0, 0.05}));
    results.push_back(points_);
  }
  set_threads(before);
  for (const auto& other : results) {
    ASSERT_EQ(other.size(), results[0].size());
    for (std::size_t i = 0; i < other.size(); ++i) EXPECT_EQ(other[i].max_q, results[0][i].max_q);
  }
}

TEST_F(EpipolarSearchTest, OnlyPixelsWithoutMapDepthAreChosen) {
  DepthImage depth(camera_.height, camera_.width, 0.0F);
  depth.colRange(0, 80) = 2.0F;
  PixelSelector selector({});
  ImmaturePointOptions options;
  options.points = 300;
  const auto half = make_immature_points(gradients_, depth, 50.0 / 255, selector, options);
  ASSERT_FALSE(half.empty());
  EXPECT_LE(half.size(), 190U);
  for (const ImmaturePoint& p : half) EXPECT_GE(p.u, 80.0F);
  depth = 2.0F;
  EXPECT_TRUE(make_immature_points(gradients_, depth, 50.0 / 255, selector, options).empty());
}

}  // namespace
}  // namespace odosplat
