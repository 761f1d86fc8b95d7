// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <optional>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {

struct ToneOptions {
  bool enabled = true;
  int spans = 6;             // of a uniform cubic B-spline over the grey values
  double sigma = 0.05;       // [grey] prior of the difference of neighbouring coefficients around 0
  double noise = 5.0 / 255;  // [grey] of one residual
  double huber = 9.0 / 255;  // [grey] residuals beyond weigh less
  double least = 2.0 / 255;  // [grey] root mean square over the points, below which a curve is not worth the work
  // Cost with a curve over the cost without one, above which it is not believed. Maps and images of one camera: 0.85
  // and more, also with pieces of the map moved or deleted; gamma 0.6: 0.1 to 0.5 for most keyframes.
  double explained = 0.8;
  double min_slope = 0.25;  // of the curve: flatter ones, or falling ones, are not a camera's

  void check() const;
};

/// What another camera, or the same with other settings, makes of grey values 0..1: a rising curve that is not straight
/// (gain and offset are the alignment's). Values at 0, 1/255 to 1, straight lines between.
using ToneCurve = std::array<float, 256>;

/// The curve that takes the reference's grey values to the target's, gain and offset apart. None if a straight one may
/// well do, and if too few points are in view. brightness: the alignment's. Pure function.
std::optional<ToneCurve> estimate_tone(const TrackingReference& reference, const FramePyramid& target,
                                       const SE3& T_target_host, const Brightness& brightness,
                                       const ToneOptions& options);

/// Of grey values 0..1; beyond, those of the ends.
GrayImage apply_tone(const GrayImage& image, const ToneCurve& curve);

}  // namespace odosplat
