// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <optional>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

struct ToneOptions {
  bool enabled = true;
  int spans = 6;                  // of a uniform cubic B-spline over the grey values
  double sigma = 0.05;            // [grey] prior of the difference of neighbouring coefficients around 0
  double noise = residual_noise;  // [grey] of one residual
  double huber = residual_huber;  // [grey] residuals beyond weigh less
  double least = 2.0 / 255;       // [grey] root mean square over the points, below which a curve is ignored
  // Cost with a curve over the cost without one, above which the curve is rejected. A map and images of the same camera
  // reach 0.85 and more, also with pieces of the map moved or deleted; with a gamma of 0.6 between them, most keyframes
  // reach 0.1 to 0.5.
  double explained = 0.8;
  double min_slope = 0.25;  // of the curve: that of a camera is not flatter, and does not fall

  void check() const;
};

/// How another camera, or the same with other settings, changes grey values 0..1: a rising curve that is not straight
/// (gain and offset belong to the alignment). Values at 0, 1/255 to 1, linear between them.
using ToneCurve = std::array<float, 256>;

/// The curve that takes the reference's grey values to the target's, apart from gain and offset. None if a straight one
/// may be enough, and if too few points are in view. brightness: the alignment's. Pure function.
std::optional<ToneCurve> estimate_tone(const TrackingReference& reference, const FramePyramid& target,
                                       const SE3& T_target_host, const Brightness& brightness,
                                       const ToneOptions& options);

/// For grey values 0..1; values outside count as 0 or 1.
GrayImage apply_tone(const GrayImage& image, const ToneCurve& curve);

}  // namespace odosplat
