// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {

/// The four uniform cubic B-splines that are not zero at a place, of which the first is number `first`.
struct Splines {
  int first = 0;
  Eigen::Vector4d value = Eigen::Vector4d::Zero();
};

/// at: 0..1 over `spans` spans, clamped. There are spans + 3 splines.
Splines splines_at(double at, int spans);

/// One point of a reference in the image that was aligned with it.
struct BrightnessSample {
  Eigen::Matrix<double, 8, 1> by_alignment;  // derivatives of the residual by pose, log gain and offset
  double host = 0.0;                         // [grey] the reference's value
  double expected = 0.0;                     // [grey] the same with the image's gain and offset
  double residual = 0.0;                     // [grey] image less expected
  double weight = 0.0;
  double u = 0.0;  // [px] in the reference, on that level
  double v = 0.0;
  double height = 0.0;    // 0..1 over the image's rows
  Splines curve;          // for a fit: the curve's splines at this sample
  double by_curve = 0.0;  // for a fit: derivative of the residual by the curve there
};

/// The points in view that are not clipped. level: of both; half size is enough for a smooth curve, and tolerates a
/// pose that is a little wrong.
std::vector<BrightnessSample> brightness_samples(const TrackingReference& reference, const FramePyramid& target,
                                                 const SE3& T_target_host, const Brightness& brightness,
                                                 std::size_t level = 1);

struct CurveFitOptions {
  int spans;         // of a uniform cubic B-spline, 1 to 50
  double sigma;      // prior of the difference of neighbouring coefficients around 0
  double noise;      // [grey] of one residual
  double huber;      // [grey] residuals beyond weigh less
  double explained;  // cost with a curve over the cost without one, above which the curve is rejected

  /// Throws InputError naming the field of `owner`.
  void check(const std::string& owner) const;
};

/// Coefficients (spans + 3; their mean is near 0, as gain and offset belong to the alignment) of the curve that the
/// samples show, fitted robustly together with a small change of the alignment, so that an alignment which the curve
/// has shifted does not hide it. None: the curve is rejected. Pure function.
std::optional<Eigen::VectorXd> fit_curve(const std::vector<BrightnessSample>& samples, const CurveFitOptions& options);

}  // namespace odosplat
