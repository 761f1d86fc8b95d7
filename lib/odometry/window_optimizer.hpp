// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/camera.hpp"
#include "odosplat/odometry/photometric_pair.hpp"
#include "odosplat/odometry/window.hpp"

namespace odosplat {

struct WindowOptimizerOptions {
  PhotometricOptions photometric;
  int max_iterations = 5;
  double gain_sigma = 0.3;           // prior of a keyframe's a around 0; of an anchor's a too
  double offset_sigma = 0.2;         // [grey] the same of b
  double gauge_translation = 0.002;  // [m] prior of the oldest keyframe's pose around its last estimate
  double gauge_rotation = 0.001;     // [rad] the same

  void check() const;
};

struct WindowSummary {
  int iterations = 0;
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int residuals = 0;  // points seen in another keyframe, outliers not counted
  int outliers = 0;
  double rmse = 0.0;            // [grey] of the keyframes' mutual residuals
  double anchor_rmse = 0.0;     // [grey] of the residuals against rendered views, 0 if there are none
  double anchor_inliers = 0.0;  // share of the newest keyframe's anchor points that agree; 0 without anchor
};

/// Photometric bundle adjustment of a window: poses and brightness of its keyframes, brightness of its anchors; every
/// keyframe's points are compared with every other keyframe, and every rendered view with its keyframe. Inverse depth
/// is no unknown: it follows from the map's planes and the host's pose. Ceres drives (Levenberg-Marquardt on the
/// manifold). The residuals of all pairs are handed to it as one block: the triangular factor of their normal
/// equations, which has the same cost, gradient and Gauss-Newton matrix as the tens of thousands of rows it stands for.
/// Pairs are evaluated on several threads and summed in fixed order.
class WindowOptimizer {
 public:
  explicit WindowOptimizer(const WindowOptimizerOptions& options);

  /// Moves the window's poses and brightness to the optimum and sets the covariance of each keyframe. A window of one
  /// keyframe without anchor is left as it is.
  WindowSummary optimize(Window& window, const Camera& camera) const;

 private:
  WindowOptimizerOptions options_;
};

}  // namespace odosplat
