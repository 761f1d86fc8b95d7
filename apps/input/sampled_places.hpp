// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat::apps {

/// Sampled poses in a map of which only the points are known [m, world]: a grid of 1 m at mid-height of the points'
/// bounding box, each with 12 level viewing directions; positions within 0.3 m of a point are left out. The shortest
/// side of the box is taken as vertical; up is -y if y is vertical (the cameras' convention), otherwise +z or +x. Less
/// reliable than poses that a camera had.
std::vector<SE3> sampled_places(const std::vector<Eigen::Vector3f>& points_world);

/// Whether Gaussian i is opaque enough to count as part of what the map shows.
inline bool counts_as_surface(const Gaussians& gaussians, std::size_t i) {
  return !(gaussians.opacity_logits[i] < -2.0F);
}

/// The places sampled around the Gaussians that count as surface.
std::vector<SE3> sampled_places(const Gaussians& gaussians);

}  // namespace odosplat::apps
