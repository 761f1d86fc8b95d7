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

/// The frame at which a path is nearest to a surface of the scene, and that distance. Only surfaces within `reach` [m]
/// are searched; if there are none, or the path is empty, the distance is `reach`. Deterministic; uses all threads.
Clearance clearance(const Scene& scene, const Trajectory& path, double reach = 0.5);

}  // namespace odosplat
