// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/relocalise/place_index.hpp"

namespace odosplat {

struct PerspectivePoseOptions {
  int iterations = 400;    // samples of RANSAC
  double max_error = 3.0;  // [px] of an inlier
  int min_inliers = 12;

  /// Throws InputError naming the field.
  void check() const;
};

struct PerspectivePose {
  SE3 T_world_camera;
  int inliers = 0;
};

/// The camera's pose from pixels that show known points, most of which may be wrong. OpenCV's P3P in RANSAC, which
/// seeds its own random numbers with a constant: the same input gives the same bits. None with too few inliers.
std::optional<PerspectivePose> perspective_pose(const Camera& camera, const std::vector<PointMatch>& matches,
                                                const PerspectivePoseOptions& options);

}  // namespace odosplat
