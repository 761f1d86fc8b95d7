// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/sensor/sensors.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/synth/sensor/row_random.hpp"

namespace odosplat {
namespace {

constexpr double disparity_unit = 351.3;  // [m * eighths of a pixel]: 8 * focal length * baseline of a Kinect

}  // namespace

void ColorSensorOptions::check() const {
  require(read_noise >= 0.0 && read_noise <= 0.5, "color_sensor.read_noise", "in 0..0.5");
  require(shot_noise >= 0.0 && shot_noise <= 0.1, "color_sensor.shot_noise", "in 0..0.1");
  require(exposure_swing >= 0.0 && exposure_swing <= 0.9, "color_sensor.exposure_swing", "in 0..0.9");
  require(exposure_period > 0.0, "color_sensor.exposure_period", "positive");
  require(offset_swing >= 0.0 && offset_swing <= 0.5, "color_sensor.offset_swing", "in 0..0.5");
}

AffineBrightness brightness_at(const ColorSensorOptions& options, double time) {
  const double phase = 2.0 * std::numbers::pi * time / options.exposure_period;
  // Gain and offset have different periods, so that one cannot compensate for the other.
  return {1.0 + options.exposure_swing * std::sin(phase), options.offset_swing * std::sin(0.7 * phase)};
}

ColorImage sense_color(const ColorImage& ideal, const ColorSensorOptions& options, int frame, double time) {
  options.check();
  const AffineBrightness brightness = brightness_at(options, time);
  ColorImage out(ideal.size());
  parallel_for(ideal.rows, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Random random = row_random(options.seed, frame, y);
      for (int x = 0; x < ideal.cols; ++x) {
        for (int c = 0; c < 3; ++c) {
          const double value = brightness.gain * ideal(y, x)[c] + brightness.offset;
          const double variance =
              options.read_noise * options.read_noise + options.shot_noise * std::clamp(value, 0.0, 1.0);
          double sensed = std::clamp(value + std::sqrt(variance) * random.normal(), 0.0, 1.0);
          if (options.quantize) sensed = std::round(255.0 * sensed) / 255.0;
          out(y, x)[c] = static_cast<float>(sensed);
        }
      }
    }
  });
  return out;
}

void DepthSensorOptions::check() const {
  require(lateral_noise >= 0.0 && lateral_noise <= 5.0, "depth_sensor.lateral_noise", "in 0..5");
  require(disparity_noise >= 0.0 && disparity_noise <= 10.0, "depth_sensor.disparity_noise", "in 0..10");
  require(range_min > 0.0 && range_max > range_min, "depth_sensor.range_max",
          "above range_min, which must be positive");
}

DepthImage sense_depth(const DepthImage& ideal, const DepthSensorOptions& options, int frame) {
  options.check();
  DepthImage out(ideal.size());
  parallel_for(ideal.rows, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Random random = row_random(options.seed, frame, y);
      for (int x = 0; x < ideal.cols; ++x) {
        const auto dx = static_cast<int>(std::lround(options.lateral_noise * random.normal()));
        const auto dy = static_cast<int>(std::lround(options.lateral_noise * random.normal()));
        const double noise = options.disparity_noise * random.normal();
        const double z = ideal(std::clamp(y + dy, 0, ideal.rows - 1), std::clamp(x + dx, 0, ideal.cols - 1));
        double sensed = 0.0;
        if (z > 0.0) sensed = disparity_unit / std::max(1.0, std::round(disparity_unit / z + noise));
        out(y, x) = sensed >= options.range_min && sensed <= options.range_max ? static_cast<float>(sensed) : 0.0F;
      }
    }
  });
  return out;
}

}  // namespace odosplat
