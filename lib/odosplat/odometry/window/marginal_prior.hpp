// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/keyframe/keyframe.hpp"

namespace odosplat {

/// The information about the keyframes of a window that is left of removed keyframes and their points, as the cost
///   g . x + x . H x / 2,   x = (log(T T_linearised^-1), a - a_linearised, b - b_linearised) a keyframe, stacked.
/// Derivatives by these keyframes are taken at the linearised poses from then on; otherwise directions in which nothing
/// is known would seem to be known (first-estimate Jacobians). Empty: no information.
struct MarginalPrior {
  struct Frame {
    std::shared_ptr<const Keyframe> keyframe;
    SE3 T_linearised;
    Brightness brightness;
  };
  std::vector<Frame> frames;
  Eigen::MatrixXd H;  // 8 rows per frame
  Eigen::VectorXd g;

  bool empty() const { return frames.empty(); }
  void clear() { *this = {}; }
  /// Index of the keyframe among frames, or -1.
  int find(const Keyframe* keyframe) const;
};

/// x of one frame at a pose and brightness; Jacobian of log taken as identity, as x is small.
Eigen::Matrix<double, 8, 1> marginal_deviation(const MarginalPrior::Frame& frame, const SE3& T_world_camera,
                                               const Brightness& brightness);

/// The prior in a world whose origin has moved: p_new = p + by.
void translate(MarginalPrior& prior, const Eigen::Vector3d& by);

/// Minimises over the parameters listed in `out` (ascending): H and g of the others, in their order. Directions of
/// `out` that hold no information are left out of the elimination.
void marginalize(Eigen::MatrixXd& H, Eigen::VectorXd& g, const std::vector<Eigen::Index>& out);

}  // namespace odosplat
