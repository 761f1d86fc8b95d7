// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <optional>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// A scene to render: Gaussians, a camera, a pose.
struct BenchScene {
  Gaussians gaussians;
  Camera camera;
  SE3 T_world_camera;
};

/// Random scene for timing: uniform centres in the image, depths 1..5 m, opacity 0.5, round Gaussians of 2 px standard
/// deviation, so that the cost depends only on the number of Gaussians and the size of the image.
BenchScene random_scene(std::size_t n, int width, int height);

/// A trained map: the PLY file in environment variable ODOSPLAT_BENCH_MAP, seen from ODOSPLAT_BENCH_POSE ("tx ty tz qx
/// qy qz qw", camera to world; the origin if not set) with the same camera as above. Nothing if ODOSPLAT_BENCH_MAP is
/// not set. Throws InputError for an invalid map or pose.
std::optional<BenchScene> map_scene(int width, int height);

}  // namespace odosplat
