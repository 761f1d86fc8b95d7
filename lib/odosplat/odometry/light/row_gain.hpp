// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

/// Gain of every row of a full-size image against that of an evenly exposed one, mean 1: flickering lamps expose the
/// rows of a rolling shutter differently. Empty: all rows alike.
using RowGain = std::vector<float>;

struct RowGainOptions {
  bool enabled = true;
  int spans = 8;                  // of a uniform cubic B-spline over the rows
  double sigma = 0.1;             // prior of the difference of neighbouring coefficients around 0
  double noise = residual_noise;  // [grey] of one residual
  double huber = residual_huber;  // [grey] residuals beyond weigh less
  double least = 0.03;            // root mean square over the rows, below which a row gain is rejected: reflections and
                                  // errors of the map look like a small one
  double explained = 0.5;  // cost with a row gain over the cost without one, above which it is rejected, too: a wrong
                           // pose or a damaged map also looks like a row gain, but is not explained by one
  double same = 0.003;     // root mean square change below which the image is not aligned again

  void check() const;
};

/// The row gain of `target` against the reference that it was aligned with: a smooth curve, fitted robustly to the
/// reference's points together with a small change of pose and brightness, so that a pose which the uneven light has
/// shifted does not hide it. Empty if the rows do not clearly differ, and if too few points are in view. target: as it
/// was taken; brightness: what it would have against the reference if all rows were alike. Pure function.
RowGain estimate_row_gain(const TrackingReference& reference, const FramePyramid& target, const SE3& T_target_host,
                          const Brightness& brightness, const RowGainOptions& options);

/// Root mean square deviation from 1.
double unevenness(const RowGain& gain);

/// The images with every row divided by its gain, level 0's gain averaged on the levels above.
FramePyramid divide_rows(const FramePyramid& pyramid, const RowGain& gain);

}  // namespace odosplat
