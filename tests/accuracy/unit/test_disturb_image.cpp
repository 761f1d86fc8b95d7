// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/accuracy/disturb/disturb_image.hpp"

namespace odosplat::accuracy {
namespace {

GrayImage ramp(int rows, int cols) {
  GrayImage image(rows, cols);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < cols; ++x) image(y, x) = static_cast<float>(0.2 + 0.6 * x / cols);
  }
  return image;
}

bool same(const GrayImage& a, const GrayImage& b) { return a.size() == b.size() && cv::countNonZero(a != b) == 0; }

TEST(ImageNoise, HasTheSpreadAndFollowsTheSeed) {
  const GrayImage image(200, 300, 0.5F);
  const GrayImage noisy = with_noise(image, 8.0 / 255, 1);
  cv::Scalar mean;
  cv::Scalar spread;
  cv::meanStdDev(noisy, mean, spread);
  EXPECT_NEAR(mean[0], 0.5, 5e-4);
  EXPECT_NEAR(255.0 * spread[0], 8.0, 0.1);
  EXPECT_TRUE(same(noisy, with_noise(image, 8.0 / 255, 1)));
  EXPECT_FALSE(same(noisy, with_noise(image, 8.0 / 255, 2)));
}

TEST(ImageNoise, StaysInRange) {
  double low = 0.0;
  double high = 0.0;
  cv::minMaxLoc(with_noise(GrayImage(50, 50, 1.0F), 0.2, 3), &low, &high);
  EXPECT_EQ(high, 1.0);
  cv::minMaxLoc(with_noise(GrayImage(50, 50, 0.0F), 0.2, 3), &low, &high);
  EXPECT_EQ(low, 0.0);
}

TEST(ImageGamma, IsThePower) {
  const GrayImage bright = with_gamma(GrayImage(3, 4, 0.25F), 0.5);
  EXPECT_FLOAT_EQ(bright(2, 3), 0.5F);
}

TEST(ImageGain, ClipsAtWhite) {
  EXPECT_FLOAT_EQ(with_gain(GrayImage(2, 2, 0.4F), 1.5)(1, 1), 0.6F);
  EXPECT_EQ(with_gain(GrayImage(2, 2, 0.8F), 1.5)(1, 1), 1.0F);
}

TEST(ExposureGain, GoesUpAndDownByOneStepAtATime) {
  EXPECT_EQ(exposure_gain(0.0, 1.5, 2.0), 1.0);
  EXPECT_EQ(exposure_gain(2.5, 1.5, 2.0), 1.5);
  EXPECT_EQ(exposure_gain(5.9, 1.5, 2.0), 1.0);
  EXPECT_EQ(exposure_gain(6.0, 1.5, 2.0), 1.0 / 1.5);
  EXPECT_EQ(exposure_gain(8.0, 1.5, 2.0), 1.0);
}

TEST(MotionBlur, SpreadsAStepOverItsLengthAlongTheMotion) {
  GrayImage step(20, 40, 0.0F);
  step.colRange(20, 40).setTo(1.0F);
  const GrayImage along = with_motion_blur(step, {3.0, 0.0}, 5.0);
  EXPECT_EQ(along(10, 16), 0.0F);
  EXPECT_GT(along(10, 17), 0.0F);  // the kernel reaches half its length to either side of the edge between 19 and 20
  EXPECT_LT(along(10, 22), 1.0F);
  EXPECT_EQ(along(10, 23), 1.0F);
  EXPECT_NEAR(along(10, 19) + along(10, 20), 1.0F, 1e-5F);  // the edge is not shifted
  EXPECT_TRUE(same(with_motion_blur(step, {0.0, -2.0}, 5.0), step));
}

TEST(MotionBlur, LeavesARampAsItIs) {
  const GrayImage image = ramp(20, 40);
  const GrayImage blurred = with_motion_blur(image, {1.0, 1.0}, 5.0);
  EXPECT_LT(cv::norm(blurred.colRange(5, 35), image.colRange(5, 35), cv::NORM_INF), 1e-6);
}

TEST(CenterMotion, IsOppositeToTheCamera) {
  const Camera camera{320, 240, 250.0, 250.0, 159.5, 119.5};
  const SE3 right(Eigen::Quaterniond::Identity(), {0.1, 0.0, 0.0});
  const Eigen::Vector2d motion = center_motion(camera, SE3(), right, 2.0);
  EXPECT_NEAR(motion.x(), -0.1 / 2.0 * 250.0, 1e-9);
  EXPECT_NEAR(motion.y(), 0.0, 1e-9);
  const SE3 turned(so3_exp({0.0, std::numbers::pi, 0.0}), Eigen::Vector3d::Zero());
  EXPECT_TRUE(center_motion(camera, SE3(), turned, 2.0).isZero());
}

TEST(RollingGain, IsAWaveOverTheRows) {
  const GrayImage rolled = with_rolling_gain(GrayImage(100, 3, 0.5F), 0.2, 0.0);
  EXPECT_FLOAT_EQ(rolled(0, 0), 0.5F);
  EXPECT_FLOAT_EQ(rolled(25, 1), 0.6F);
  EXPECT_FLOAT_EQ(rolled(75, 2), 0.4F);
  EXPECT_FLOAT_EQ(with_rolling_gain(GrayImage(100, 3, 0.5F), 0.2, 0.25)(0, 0), 0.6F);
}

}  // namespace
}  // namespace odosplat::accuracy
