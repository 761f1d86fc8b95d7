// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Noise and brightness changes of a colour camera. Every frame of a sequence has its own noise.
struct ColorSensorOptions {
  double read_noise = 0.004;     // standard deviation of a channel (0..1), 0..0.5: one grey level of 255
  double shot_noise = 0.0002;    // variance per unit of brightness, 0..0.1
  double exposure_swing = 0.0;   // auto exposure: amplitude of the periodic gain change, relative, 0..0.9
  double exposure_period = 4.0;  // [s] period of that change, > 0
  double offset_swing = 0.0;     // amplitude of a periodic brightness offset, 0..0.5
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

/// The camera's image for frame number `frame` at a time [s]: brightness change, noise of variance read_noise^2 +
/// shot_noise * value, clamped to 0..1. Deterministic in seed and frame, whatever the number of threads.
ColorImage sense_color(const ColorImage& ideal, const ColorSensorOptions& options, int frame, double time);

/// Noise and range of a structured-light depth camera.
struct DepthSensorOptions {
  double lateral_noise = 0.5;       // [px] standard deviation of the measured position, 0..5
  double disparity_noise = 0.1667;  // [eighths of a pixel of disparity] standard deviation, 0..10
  double range_min = 0.5;           // [m] > 0; nearer depths become 0 (missing)
  double range_max = 5.0;           // [m] > range_min
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// Depth with the noise of a Kinect. Source: Barron and Malik 2013 as used by Handa et al. 2014 for ICL-NUIM: the
/// measured position is shifted randomly, and disparity (351.3 / z in eighths of a pixel, z in metres) is shifted and
/// rounded. The quantisation step of depth is thus z^2 / 351.3: 2.8 mm at 1 m, 26 mm at 3 m. Deterministic in seed and
/// frame.
DepthImage sense_depth(const DepthImage& ideal, const DepthSensorOptions& options, int frame);

}  // namespace odosplat
