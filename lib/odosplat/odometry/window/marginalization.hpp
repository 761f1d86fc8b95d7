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
  int min_agreeing = 2;  // keyframes that must agree with an estimated point for its residuals to be kept
  double weight = 0.25;  // factor of what is kept: errors of neighbouring residuals are correlated, and the
                         // linearisation is not updated

  void check() const;
};

/// Takes keyframe `index` out of the window and keeps the information that it and its points gave about the others as
/// the window's marginal prior (Schur complement; reference: Leutenegger et al. 2015, DSO section 2.4). The prior
/// contains
/// - all residuals of the keyframe's own points, except estimated ones that too few keyframes agree with,
/// - the residuals in the keyframe of the others' points that are not estimated,
/// - its anchors,
/// - its priors of pose and brightness.
/// Residuals in it of the others' estimated points are dropped: eliminating these would couple all their keyframes
/// while they are still needed. With `enabled` false, only what the window's prior already held about the others is
/// kept.
void marginalize_keyframe(Window& window, std::size_t index, const Camera& camera,
                          const WindowOptimizerOptions& optimizer, const MarginalizationOptions& options);

}  // namespace odosplat
