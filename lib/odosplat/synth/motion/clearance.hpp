// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/synth/scene/scene.hpp"

namespace odosplat {

struct Clearance {
  double distance = 0.0;  // [m]
  std::size_t frame = 0;
};

/// Where a path comes nearest to anything in the scene, looked for within `reach` [m] of its positions; if nothing is
/// so near, the distance is `reach`. An empty path likewise. Deterministic, on all threads.
Clearance clearance(const Scene& scene, const Trajectory& path, double reach = 0.5);

}  // namespace odosplat
