// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace odosplat {

/// Some consecutive points of a cloud, as a reader passes them on while it reads a file. World frame. Positions are in
/// double precision, so that a cloud far from the origin can be shifted before it is rounded to single precision.
struct CloudBatch {
  std::vector<Eigen::Vector3d> points;   // [m], finite
  std::vector<Eigen::Vector3f> colors;   // 0..1, R G B; empty or as long as points
  std::vector<Eigen::Vector3f> normals;  // unit length, or zero where a point has none; empty or as long as points
};

/// The point in single precision, as PointCloud stores it [m]. Throws InputError naming `name` if rounding would move a
/// coordinate by more than 1 mm, which happens in survey frames with coordinates of millions of metres.
Eigen::Vector3f round_point(const std::string& name, const Eigen::Vector3d& point);

}  // namespace odosplat
