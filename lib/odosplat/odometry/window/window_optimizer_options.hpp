// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/odometry/window/photometric_pair.hpp"

namespace odosplat {

struct WindowOptimizerOptions {
  PhotometricOptions photometric;
  int max_iterations = 5;            // accepted steps
  double converged = 1e-4;           // relative decrease of the cost by a step below which it was the last
  double gain_sigma = 0.3;           // prior of a keyframe's a around 0; of an anchor's a too
  double offset_sigma = 0.2;         // [grey] the same of b
  double gauge_translation = 0.002;  // [m] prior of the oldest keyframe's pose around its last estimate; unused if
                                     // there is a marginal prior
  double gauge_rotation = 0.001;     // [rad] the same
  // Prior of a keyframe's pose around its tracked pose. Images with texture determine the pose far better; in front of
  // a bare wall, noise alone would move the window by up to decimetres a keyframe.
  double tracked_translation = 0.002;  // [m]
  double tracked_rotation = 0.001;     // [rad]

  void check() const;
};

}  // namespace odosplat
