// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/map/sensor_view.hpp"

namespace odosplat {

/// Focal length of the Kinect's camera, which has 640 x 480 pixels. Noise is scaled for cameras with other focal
/// lengths.
inline constexpr double kinect_focal_px = 525.0;

struct KinectOptions {
  SensorViewOptions axial;        // standard deviation of depth, including quantisation
  double lateral_noise = 0.8;     // [px of the Kinect] standard deviation of the measured position, 0..5
  double baseline = 0.075;        // [m] between camera and projector, > 0
  double disparity_step = 0.125;  // [px of the Kinect] > 0
  double range_min = 0.5;         // [m] > 0; nearer depths are missing
  double range_max = 5.0;         // [m] > range_min; farther depths are missing
  double max_angle_deg = 80.0;    // between normal and ray, 0..90; depths at larger angles are missing
  double edge_share = 0.05;       // larger relative changes of inverse depth between neighbours: both are missing, > 0
  std::uint64_t seed = 1;

  /// Throws InputError naming the field.
  void check() const;
};

/// True depth as a Kinect would measure it: the measured position is shifted randomly (by whole pixels, independently
/// for each pixel), depth gets axial noise, disparity is rounded to its step, and depth is missing out of range, at
/// grazing angles and beside depth edges. Source of the axial standard deviation, 0.0012 + 0.0019 (z - 0.4)^2 m, and of
/// the lateral one: Nguyen, Izadi, Lovell 2012, "Modeling Kinect sensor noise for improved 3D reconstruction and
/// tracking". Their axial value includes the rounding, so noise is added with that variance minus the variance of the
/// rounding, step^2 / 12. camera: must have the size of `ideal`, else InputError. Deterministic in seed and frame,
/// whatever the number of threads.
DepthImage sense_kinect_depth(const DepthImage& ideal, const Camera& camera, const KinectOptions& options, int frame);

}  // namespace odosplat
