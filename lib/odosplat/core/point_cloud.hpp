// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace odosplat {

/// Points of a map in its world frame [m]. colors (0..1, R G B) and normals (unit length) are either empty or as long
/// as points.
struct PointCloud {
  std::vector<Eigen::Vector3f> points;
  std::vector<Eigen::Vector3f> colors;
  std::vector<Eigen::Vector3f> normals;

  std::size_t size() const { return points.size(); }
  bool has_colors() const { return !points.empty() && colors.size() == points.size(); }
  bool has_normals() const { return !points.empty() && normals.size() == points.size(); }
};

}  // namespace odosplat
