// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/light/residual_weights.hpp"
#include "tests/odometry/room_pair.hpp"

namespace odosplat {
namespace {

class ResidualWeightsTest : public test::RoomPairTest {
 protected:
  ResidualWeights grid(const FramePyramid& target, const ResidualWeightOptions& options = {.noise = 4.0 / 255}) const {
    return residual_weights(camera_, brightness_samples(reference_, target, T_target_host_, {}, 0), options);
  }
};

TEST_F(ResidualWeightsTest, WhereAllAgreesAllWeighsInFull) {
  const ResidualWeights all = grid(*seen([](GrayImage&) {}));
  EXPECT_EQ(all.columns, 20);
  EXPECT_EQ(all.rows, 15);
  ASSERT_EQ(all.weight.size(), 300U);
  for (const double weight : all.weight) EXPECT_EQ(weight, 1.0);
}

TEST_F(ResidualWeightsTest, WhereTheImageIsAnotherPointsWeighLess) {
  // The left half of the image is 20 grey levels brighter: residuals of five times the noise.
  const auto target = seen([](GrayImage& image) { image.colRange(0, image.cols / 2) += 20.0F / 255.0F; });
  const ResidualWeights half = grid(*target);
  int points_left = 0;
  for (const ReferencePoint& point : reference_.levels.front()) {
    // Near the border between the halves both weights are possible, because of the camera's motion and a block's width.
    if (point.u > 68.0F && point.u < 92.0F) continue;
    const bool left = point.u < 80.0F;
    points_left += left ? 1 : 0;
    const double weight = half.at(point.u, point.v);
    if (left) {
      EXPECT_LT(weight, 0.9);
    } else {
      EXPECT_EQ(weight, 1.0);
    }
  }
  EXPECT_GT(points_left, 100);
}

TEST_F(ResidualWeightsTest, IsTheInverseVarianceOfTheResiduals) {
  ResidualWeightOptions options;
  options.columns = 1;
  options.prior = 1e-6;
  const double residual = 10.0 / 255;
  const auto target = seen([&](GrayImage& image) { image += residual; });
  EXPECT_NEAR(grid(*target, options).at(80.0, 60.0), std::pow(options.noise / residual, 2), 0.01);
  const auto far = seen([&](GrayImage& image) { image += 0.3; });
  EXPECT_NEAR(grid(*far, options).at(80.0, 60.0), std::pow(options.noise / options.outlier, 2), 1e-6);
}

TEST_F(ResidualWeightsTest, BadOptionsAreRefused) {
  ResidualWeightOptions options;
  options.noise = 0.0;
  EXPECT_THROW(options.check(), InputError);
}

}  // namespace
}  // namespace odosplat
