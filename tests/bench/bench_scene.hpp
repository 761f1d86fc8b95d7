// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <optional>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// What is rendered: Gaussians, a camera, a pose.
struct BenchScene {
  Gaussians gaussians;
  Camera camera;
  SE3 T_world_camera;
};

/// The scene of the measured notes: uniform centres on the screen, depths 1..5 m, opacity 0.5, round Gaussians of 2 px
/// standard deviation, so that cost depends on the count and the size of the image alone.
BenchScene random_scene(std::size_t n, int width, int height);

/// A trained map: the PLY that environment variable ODOSPLAT_BENCH_MAP names, seen from ODOSPLAT_BENCH_POSE
/// ("tx ty tz qx qy qz qw", camera to world; the origin if not set) with the same camera as above. Nothing if there is
/// no such variable. Throws InputError for a broken map or pose.
std::optional<BenchScene> map_scene(int width, int height);

}  // namespace odosplat
