// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// What a colour camera does to an ideal image. Every frame of a sequence has its own noise.
struct ColorSensorOptions {
  double read_noise = 0.004;     // standard deviation of a channel (0..1), 0..0.5: one grey level of 255
  double shot_noise = 0.0002;    // variance a unit of brightness, 0..0.1
  double exposure_swing = 0.0;   // auto exposure: gain goes up and down by this share, 0..0.9
  double exposure_period = 4.0;  // [s] of the swing, > 0
  double offset_swing = 0.0;     // brightness added goes up and down by this much, 0..0.5
  bool quantize = true;          // to 8 bits, as image files do
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// Brightness change of a frame: value -> gain * value + offset, on stored values.
struct AffineBrightness {
  double gain = 1.0;
  double offset = 0.0;
};

/// The brightness change at a time [s]; 1 and 0 at time 0.
AffineBrightness brightness_at(const ColorSensorOptions& options, double time);

/// The image as the camera gives it for frame number `frame` at a time [s]: brightness change, noise of variance
/// read_noise^2 + shot_noise * value, clamped to 0..1. Deterministic in seed and frame, whatever the number of threads.
ColorImage sense_color(const ColorImage& ideal, const ColorSensorOptions& options, int frame, double time);

/// What a structured-light camera does to depth.
struct DepthSensorOptions {
  double lateral_noise = 0.5;       // [px] standard deviation of the place that is measured, 0..5
  double disparity_noise = 0.1667;  // [eighths of a pixel of disparity] standard deviation, 0..10
  double range_min = 0.5;           // [m] > 0; 0 is given for what is nearer
  double range_max = 5.0;           // [m] > range_min
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// Depth as a Kinect gives it. Source: Barron and Malik 2013 as used by Handa et al. 2014 for ICL-NUIM: the measured
/// place is shifted at random, and disparity (351.3 / z in eighths of a pixel, z in metres) is shifted and rounded. The
/// step of depth is thus z^2 / 351.3: 2.8 mm at 1 m, 26 mm at 3 m. Deterministic in seed and frame.
DepthImage sense_depth(const DepthImage& ideal, const DepthSensorOptions& options, int frame);

}  // namespace odosplat
