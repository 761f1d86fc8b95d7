// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/sensor/sensors.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

TEST(ColorSensor, NoiseHasTheVarianceItSays) {
  ColorSensorOptions options;
  options.read_noise = 0.02;
  options.shot_noise = 0.002;
  options.quantize = false;
  for (const float level : {0.2F, 0.5F, 0.7F}) {
    const ColorImage ideal(200, 300, cv::Vec3f(level, level, level));
    const ColorImage sensed = sense_color(ideal, options, 3, 0.0);
    double sum = 0.0;
    double square = 0.0;
    for (const cv::Vec3f& p : sensed) {
      for (int c = 0; c < 3; ++c) {
        sum += p[c] - level;
        square += (p[c] - level) * (p[c] - level);
      }
    }
    const double n = 3.0 * 200 * 300;
    const double variance = 0.02 * 0.02 + 0.002 * level;
    EXPECT_NEAR(sum / n, 0.0, 5.0 * std::sqrt(variance / n));
    EXPECT_NEAR(square / n / variance, 1.0, 5.0 * std::sqrt(2.0 / n));
  }
}

TEST(ColorSensor, BrightnessChangeIsAffineAndStartsAtNone) {
  ColorSensorOptions options;
  options.read_noise = 0.0;
  options.shot_noise = 0.0;
  options.exposure_swing = 0.3;
  options.offset_swing = 0.05;
  options.quantize = false;
  EXPECT_EQ(brightness_at(options, 0.0).gain, 1.0);
  EXPECT_EQ(brightness_at(options, 0.0).offset, 0.0);
  const AffineBrightness b = brightness_at(options, 1.0);
  EXPECT_NEAR(b.gain, 1.3, 1e-12);  // at a quarter of the period
  for (const float level : {0.1F, 0.4F, 0.6F}) {
    const ColorImage sensed = sense_color(ColorImage(2, 2, cv::Vec3f(level, level, level)), options, 0, 1.0);
    EXPECT_NEAR(sensed(1, 1)[1], b.gain * level + b.offset, 1e-6);
  }
  const ColorImage bright = sense_color(ColorImage(1, 1, cv::Vec3f(0.9F, 0.9F, 0.9F)), options, 0, 1.0);
  EXPECT_EQ(bright(0, 0)[0], 1.0F);
}

TEST(ColorSensor, QuantizedValuesAreThoseOfEightBits) {
  const ColorImage sensed = sense_color(ColorImage(40, 40, cv::Vec3f(0.31F, 0.52F, 0.77F)), {}, 1, 0.0);
  for (const cv::Vec3f& p : sensed) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(255.0F * p[c], std::round(255.0F * p[c]), 1e-4F);
  }
}

TEST(ColorSensor, FramesDifferThreadsDoNot) {
  const ColorImage ideal(65, 43, cv::Vec3f(0.3F, 0.5F, 0.7F));
  const int before = threads();
  set_threads(1);
  const ColorImage a = sense_color(ideal, {}, 5, 0.2);
  set_threads(2);
  const ColorImage b = sense_color(ideal, {}, 5, 0.2);
  set_threads(before);
  EXPECT_EQ(0, cv::norm(a, b, cv::NORM_INF));
  EXPECT_GT(cv::norm(a, sense_color(ideal, {}, 6, 0.2), cv::NORM_INF), 0.0);
}

TEST(DepthSensor, StepsGrowWithTheSquareOfDepth) {
  DepthSensorOptions options;
  options.lateral_noise = 0.0;
  options.disparity_noise = 0.0;
  for (const float z : {0.8F, 1.7F, 3.1F, 4.9F}) {
    const DepthImage sensed = sense_depth(DepthImage(4, 4, z), options, 0);
    EXPECT_LE(std::abs(sensed(2, 2) - z), 0.51F * z * z / 351.3F * (1.0F + z / 351.3F));
    const double disparity = 351.3 / sensed(2, 2);
    EXPECT_NEAR(disparity, std::round(disparity), 1e-3);
  }
}

TEST(DepthSensor, NoiseIsUnbiasedInDisparity) {
  DepthSensorOptions options;
  options.lateral_noise = 0.0;
  options.disparity_noise = 2.0;
  const float z = 2.0F;
  const DepthImage sensed = sense_depth(DepthImage(200, 300, z), options, 0);
  double sum = 0.0;
  double square = 0.0;
  for (const float value : sensed) {
    const double e = 351.3 / value - 351.3 / z;
    sum += e;
    square += e * e;
  }
  const double n = 200.0 * 300.0;
  EXPECT_NEAR(sum / n, 0.0, 0.05);
  EXPECT_NEAR(square / n, 4.0 + 1.0 / 12.0, 0.15);  // variances of the noise and of rounding
}

TEST(DepthSensor, GivesNothingOutsideItsRange) {
  DepthImage ideal(1, 4);
  ideal << 0.3F, 2.0F, 6.0F, 0.0F;
  DepthSensorOptions options;
  options.lateral_noise = 0.0;
  const DepthImage sensed = sense_depth(ideal, options, 0);
  EXPECT_EQ(sensed(0, 0), 0.0F);
  EXPECT_GT(sensed(0, 1), 1.9F);
  EXPECT_EQ(sensed(0, 2), 0.0F);
  EXPECT_EQ(sensed(0, 3), 0.0F);
}

TEST(Sensors, RefuseWrongOptions) {
  ColorSensorOptions color;
  color.exposure_period = 0.0;
  EXPECT_THROW(sense_color(ColorImage(1, 1), color, 0, 0.0), InputError);
  DepthSensorOptions depth;
  depth.range_max = 0.2;
  EXPECT_THROW(sense_depth(DepthImage(1, 1), depth, 0), InputError);
}

}  // namespace
}  // namespace odosplat
