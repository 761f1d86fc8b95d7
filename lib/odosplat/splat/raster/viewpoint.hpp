// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// What of camera and pose the kernels take (projection.cl).
struct Viewpoint {
  std::array<float, 16> pose{};        // rotation world to camera, translation, camera centre
  std::array<float, 8> lens{};         // fx, fy, cx, cy, range of x/z and y/z where the perspective's slope follows
  std::array<std::int32_t, 4> grid{};  // width, height [px], tiles a row, rows of tiles
  std::size_t tiles = 0;
  std::size_t pixels = 0;
};

/// Camera and pose must have passed their checks.
Viewpoint make_viewpoint(const Camera& camera, const SE3& T_world_camera);

}  // namespace odosplat
