// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Camera and pose as the kernels take them (projection.cl).
struct Viewpoint {
  std::array<float, 16> pose{};        // rotation world to camera, translation, camera centre
  std::array<float, 8> lens{};         // fx, fy, cx, cy, and the range of x/z and y/z that the Jacobian of the
                                       // projection is limited to
  std::array<std::int32_t, 4> grid{};  // width, height [px], tiles per row, rows of tiles
  std::size_t tiles = 0;
  std::size_t pixels = 0;
};

/// Camera and pose must have passed their checks.
Viewpoint make_viewpoint(const Camera& camera, const SE3& T_world_camera);

}  // namespace odosplat
