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
  int max_iterations = 5;            // accepted steps
  double converged = 1e-4;           // relative decrease of the cost by a step below which it was the last
  double gain_sigma = 0.3;           // prior of a keyframe's a around 0; of an anchor's a too
  double offset_sigma = 0.2;         // [grey] the same of b
  double gauge_translation = 0.002;  // [m] prior of the oldest keyframe's pose around its last estimate; not where a
                                     // marginal prior stands
  double gauge_rotation = 0.001;     // [rad] the same
  // Prior of a keyframe's pose around the one that it was tracked to: images that say anything say far more, but before
  // a bare wall noise alone carried the window away (a stand-in's wall: decimetres a keyframe).
  double tracked_translation = 0.002;  // [m]
  double tracked_rotation = 0.001;     // [rad]

  void check() const;
};

struct WindowSummary {
  int iterations = 0;   // accepted steps
  int evaluations = 0;  // of the whole window
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int residuals = 0;  // points seen in another keyframe, outliers not counted
  int outliers = 0;
  double rmse = 0.0;  // [grey] of the keyframes' mutual residuals
};

/// Photometric bundle adjustment of a window: poses and brightness of its keyframes, brightness of its anchors, and the
/// inverse depths that are estimated; every keyframe's points are compared with every other keyframe, and every
/// anchor with its keyframe. Source: Engel, Koltun, Cremers 2018 (DSO); Levenberg-Marquardt with the offsets
/// eliminated (Schur complement), so that 8 parameters a keyframe and 2 an anchor are left. Differs: a step that does
/// not lower the cost is taken back; no null space is projected out. Same bits for any number of threads. Ceres is the
/// tests' second opinion: it reaches the same optimum. It drove this adjustment before, on the same equations in double
/// precision, and took 66 ms of CPU time a full window of seven keyframes on icl_office_kt3 (release build) where this
/// takes 30 (pose_aware depth, 350 points a keyframe and 700 an anchor, one thread).
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
