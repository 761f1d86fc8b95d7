// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/odometry/window/window.hpp"
#include "odosplat/odometry/window/window_optimizer_options.hpp"

namespace odosplat {

struct WindowSummary {
  int iterations = 0;  // accepted steps
  double initial_cost = 0.0;
  double final_cost = 0.0;
};

/// Photometric bundle adjustment of a window: poses and brightness of its keyframes, brightness of its anchors, and the
/// inverse depths that are estimated; every keyframe's points are compared with every other keyframe, and every
/// anchor with its keyframe. Source: Engel, Koltun, Cremers 2018 (DSO); Levenberg-Marquardt with the offsets
/// eliminated (Schur complement), so that 8 parameters a keyframe and 2 an anchor are left. Differs: a step that does
/// not lower the cost is taken back; no null space is projected out. Same bits for any number of threads. The tests
/// check that Ceres reaches the same optimum.
class WindowOptimizer {
 public:
  explicit WindowOptimizer(const WindowOptimizerOptions& options);

  /// Moves the window to the optimum and sets the covariance of each keyframe, and of each estimated point how many
  /// keyframes agree with it. A window of one keyframe without anchor is left as it is.
  WindowSummary optimize(Window& window, const Camera& camera) const;

  const WindowOptimizerOptions& options() const { return options_; }

 private:
  WindowOptimizerOptions options_;
};

}  // namespace odosplat
