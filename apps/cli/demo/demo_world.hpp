// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/trajectory.hpp"

namespace odosplat::apps {

struct DemoOptions {
  int width = 320;   // [px]
  int height = 240;  // [px]
  int frames = 240;  // at 30 a second
  int iterations = 1200;
  std::uint64_t seed = 1;
};

/// Replaces a recorded sequence and a scanned cloud.
struct DemoWorld {
  std::string sequence;  // folder in TUM layout, with true depth and poses (for judging only)
  std::string cloud;     // PLY
  Camera camera;
  Trajectory truth;
};

/// Renders a camera's path through a furnished synthetic room and scans the room with a simulated lidar. Writes
/// OUT/sequence and OUT/cloud.ply. The same options give the same bytes.
DemoWorld make_demo_world(const std::string& out, const DemoOptions& options);

}  // namespace odosplat::apps
