// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/camera/camera.hpp"
#include "odosplat/odometry/window/window_optimizer.hpp"

namespace odosplat::test {

struct CeresOutcome {
  double initial_cost = 0.0;
  double final_cost = 0.0;
  int iterations = 0;
};

/// The window's adjustment by Ceres, as an independent check of the library's solver: the same costs in one block of
/// all poses, brightness values and offsets, whose Jacobian is a factor of their normal equations. No unknowns are
/// eliminated. Changes the window as the library's solver does.
CeresOutcome optimize_with_ceres(Window& window, const Camera& camera, const WindowOptimizerOptions& options,
                                 int max_iterations);

}  // namespace odosplat::test
