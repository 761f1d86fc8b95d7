// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// What of a map remains when it is thinned to its most visible Gaussians.
struct VisibleGaussians {
  std::vector<std::size_t> rows;  // indices, ascending
  double share = 1.0;             // of the visibility of all Gaussians, 0..1
};

/// The `most` Gaussians of the largest visibility, all if there are no more. The visibility of a Gaussian is its
/// opacity times its solid angle, the product of its two largest standard deviations over the squared distance (0.1 m
/// at least), summed over the cameras (T_world_camera; at most 100 of them, evenly spaced). Directions and occlusion
/// are not regarded. Without cameras the distance is 1. Of equally visible ones the first. Those whose opacity is below
/// MIN_ALPHA (constants.h), which are never drawn, are left out in any case.
VisibleGaussians most_visible(const Gaussians& gaussians, const std::vector<SE3>& cameras, std::size_t most);

}  // namespace odosplat
