// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>

#include "odosplat/camera/camera.hpp"
#include "odosplat/odometry/window/window_optimizer.hpp"

namespace odosplat {

struct MarginalizationOptions {
  /// docs/rules.md has errors with and without.
  bool enabled = true;
  int min_agreeing = 2;  // keyframes that must agree with an estimated point for what it says to be kept
  double weight = 0.25;  // of what is kept: neighbouring residuals err alike, and stay linearised where they were

  void check() const;
};

/// Takes keyframe `index` out of the window and keeps what it and its points said of the others as the window's
/// marginal prior (Schur complement; reference: Leutenegger et al. 2015, DSO section 2.4). In it go: all residuals of
/// the keyframe's own points, save estimated ones that too few keyframes agree with; those of the others' map points in
/// the keyframe; its anchors; its brightness priors. Residuals in it of the others' estimated points are dropped:
/// eliminating these would tie all their keyframes together while they are still needed. With `enabled` false only what
/// the window's prior already held of the others is kept.
void marginalize_keyframe(Window& window, std::size_t index, const Camera& camera,
                          const WindowOptimizerOptions& optimizer, const MarginalizationOptions& options);

}  // namespace odosplat
