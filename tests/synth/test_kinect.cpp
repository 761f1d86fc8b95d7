// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/sensor/kinect.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

const Camera camera_640{640, 480, 525.0, 525.0, 319.5, 239.5};

// Depth along z of a plane through (0, 0, z0) whose normal is turned by `angle` [rad] about y.
DepthImage slanted(const Camera& camera, double z0, double angle) {
  DepthImage depth(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const double z = z0 / (1.0 + std::tan(angle) * camera.ray(x, y).x());
      depth(y, x) = z > 0.0 ? static_cast<float>(z) : 0.0F;
    }
  }
  return depth;
}

int missing(const DepthImage& depth, const cv::Rect& region) { return region.area() - cv::countNonZero(depth(region)); }

TEST(Kinect, DeviationOfDepthFollowsTheFormula) {
  for (const double z : {1.0, 2.0, 3.0, 4.0}) {
    // Depths around z, since a single depth could coincide with a step of the disparity.
    DepthImage ideal(480, 640);
    for (int x = 0; x < 640; ++x) ideal.col(x) = static_cast<float>(z * (0.99 + 0.02 * x / 640));
    KinectOptions options;
    options.lateral_noise = 0.0;
    const DepthImage sensed = sense_kinect_depth(ideal, camera_640, options, 3);
    double sum = 0.0;
    double squares = 0.0;
    for (int y = 0; y < 480; ++y) {
      for (int x = 0; x < 640; ++x) {
        ASSERT_GT(sensed(y, x), 0.0F);
        const double e = static_cast<double>(sensed(y, x)) - static_cast<double>(ideal(y, x));
        sum += e;
        squares += e * e;
      }
    }
    const double n = 640.0 * 480.0;
    const double expected = 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4);  // as published
    EXPECT_NEAR(std::sqrt(squares / n), expected, 0.05 * expected) << z;
    EXPECT_NEAR(sum / n, 0.0, 0.05 * expected) << z;
  }
}

TEST(Kinect, DisparityIsInEighthsOfAPixel) {
  const DepthImage sensed = sense_kinect_depth(slanted(camera_640, 2.0, 0.5), camera_640, {}, 0);
  int seen = 0;
  for (const float z : sensed) {
    if (z == 0.0F) continue;
    ++seen;
    const double eighths = 8.0 * 525.0 * 0.075 / z;
    ASSERT_NEAR(eighths, std::round(eighths), 1e-3);
  }
  EXPECT_GT(seen, 100000);
}

TEST(Kinect, PlacesAreShiftedByTheLateralDeviation) {
  // On a slanted plane the depth determines the column at which it was measured.
  KinectOptions options;
  options.axial.sigma_constant = 1e-9;
  options.axial.sigma_square = 0.0;
  options.disparity_step = 1e-4;
  for (const double scale : {1.0, 2.0}) {
    const Camera camera = camera_640.resized(static_cast<int>(640 * scale), static_cast<int>(480 * scale));
    const double angle = 0.6;
    const DepthImage sensed = sense_kinect_depth(slanted(camera, 1.5, angle), camera, options, 0);
    double squares = 0.0;
    int n = 0;
    for (int y = 10; y < camera.height - 10; ++y) {
      for (int x = 10; x < camera.width - 10; ++x) {
        const double column = (1.5 / sensed(y, x) - 1.0) / std::tan(angle) * camera.fx + camera.cx;
        squares += (column - x) * (column - x);
        ++n;
      }
    }
    // Rounding to whole pixels adds a variance of 1/12.
    EXPECT_NEAR(squares / n, 0.64 * scale * scale + 1.0 / 12.0, 0.02 * scale * scale) << scale;
  }
}

TEST(Kinect, DepthIsMissingOutOfRangeAtGrazingAnglesAndAtEdges) {
  KinectOptions options;
  options.lateral_noise = 0.0;
  const cv::Rect middle(300, 200, 40, 80);
  for (const double z : {0.4, 5.2}) {
    EXPECT_EQ(missing(sense_kinect_depth(DepthImage(480, 640, static_cast<float>(z)), camera_640, options, 0), middle),
              middle.area());
  }
  const double degree = 3.14159265358979323846 / 180.0;
  EXPECT_EQ(missing(sense_kinect_depth(slanted(camera_640, 1.5, 70.0 * degree), camera_640, options, 0), middle), 0);
  EXPECT_EQ(missing(sense_kinect_depth(slanted(camera_640, 1.5, 84.0 * degree), camera_640, options, 0), middle),
            middle.area());
  DepthImage step(480, 640, 2.0F);
  step.colRange(0, 320) = 1.5F;
  step(100, 100) = 0.0F;
  const DepthImage sensed = sense_kinect_depth(step, camera_640, options, 0);
  EXPECT_EQ(missing(sensed, cv::Rect(319, 0, 2, 480)), 2 * 480);  // both sides of the edge
  EXPECT_EQ(missing(sensed, cv::Rect(0, 0, 640, 480)), 2 * 480 + 1);
}

TEST(Kinect, SameSeedSameBitsWhateverTheThreads) {
  const DepthImage ideal = slanted(camera_640, 2.0, 0.3);
  const int before = threads();
  set_threads(1);
  const DepthImage a = sense_kinect_depth(ideal, camera_640, {}, 5);
  set_threads(3);
  const DepthImage b = sense_kinect_depth(ideal, camera_640, {}, 5);
  set_threads(before);
  EXPECT_EQ(cv::norm(a, b, cv::NORM_INF), 0.0);
  KinectOptions other;
  other.seed = 2;
  EXPECT_GT(cv::norm(a, sense_kinect_depth(ideal, camera_640, {}, 6), cv::NORM_INF), 0.0);
  EXPECT_GT(cv::norm(a, sense_kinect_depth(ideal, camera_640, other, 5), cv::NORM_INF), 0.0);
}

TEST(Kinect, RefusesOtherSizesAndBadOptions) {
  EXPECT_THROW(sense_kinect_depth(DepthImage(3, 3, 1.0F), camera_640, {}, 0), InputError);
  for (const auto spoil :
       {+[](KinectOptions& o) { o.lateral_noise = -1.0; }, +[](KinectOptions& o) { o.baseline = 0.0; },
        +[](KinectOptions& o) { o.disparity_step = std::nan(""); }, +[](KinectOptions& o) { o.range_max = 0.1; },
        +[](KinectOptions& o) { o.max_angle_deg = 91.0; }, +[](KinectOptions& o) { o.edge_share = 0.0; },
        +[](KinectOptions& o) { o.axial.sigma_constant = 0.0; }}) {
    KinectOptions options;
    spoil(options);
    EXPECT_THROW(sense_kinect_depth(DepthImage(480, 640, 1.0F), camera_640, options, 0), InputError);
  }
}

}  // namespace
}  // namespace odosplat
