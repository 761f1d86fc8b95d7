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

/// The window's adjustment by Ceres: the same costs in one block of all poses, brightness and offsets, whose Jacobian
/// is the triangular factor of their normal equations, none of them eliminated. A second opinion on the library's own
/// solver. Moves the window as that does.
CeresOutcome optimize_with_ceres(Window& window, const Camera& camera, const WindowOptimizerOptions& options,
                                 int max_iterations);

}  // namespace odosplat::test
