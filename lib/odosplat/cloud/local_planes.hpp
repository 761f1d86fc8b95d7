// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// The surface around a point of a cloud.
struct LocalPlane {
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  // unit length; its largest component is positive
  float residual = 0.0F;                              // [m] rms distance of the neighbours from the plane
};

/// For every point the plane fitted to it and its k nearest neighbours by principal components: the normal is the
/// direction of least spread. The sum of squares is divided by the remaining degrees of freedom, k + 1 - 3, so that the
/// residual estimates the points' noise. Fewer than 4 points in the cloud give residual 0, fewer than 3 the default
/// normal. k >= 3, else InputError. Uses all threads; bit-identical for any number of threads.
std::vector<LocalPlane> fit_local_planes(const PointCloud& cloud, int k);

}  // namespace odosplat
