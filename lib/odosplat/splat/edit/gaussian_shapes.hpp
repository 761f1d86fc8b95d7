// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// What the tools that edit maps look at, one value per Gaussian.
struct GaussianShapes {
  /// Centres [m, world], normals (the shortest axis, unit length, either sign: of a flat Gaussian that of its surface) and
  /// colours of degree 0 (not clamped).
  PointCloud cloud;
  std::vector<char> flat;        // 1: the shortest axis is at most half of the middle one
  std::vector<float> thickness;  // [m] standard deviation along the shortest axis
  std::vector<float> length;     // [m] along the longest one
  std::vector<float> opacities;  // 0..1
  std::vector<float> spacings;   // [m] mean distance to the six nearest centres; 0 if there is no other

  std::size_t size() const { return opacities.size(); }
};

/// Uses all threads; bit-identical for any number of threads. Throws InputError as Gaussians::check.
GaussianShapes gaussian_shapes(const Gaussians& gaussians);

/// Unit vector along the longest axis of Gaussian i, world frame.
Eigen::Vector3f longest_axis(const Gaussians& gaussians, std::size_t i);

}  // namespace odosplat
