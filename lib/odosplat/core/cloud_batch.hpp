// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace odosplat {

/// Some consecutive points of a cloud on their way from a file to whoever collects them; positions in double precision,
/// so that a cloud far from the origin can be moved before it is rounded. World frame.
struct CloudBatch {
  std::vector<Eigen::Vector3d> points;   // [m], finite
  std::vector<Eigen::Vector3f> colors;   // 0..1, R G B; empty or as long as points
  std::vector<Eigen::Vector3f> normals;  // unit length, or zero where a point has none; empty or as long as points
};

/// The point in single precision, as clouds keep it [m]. InputError naming `name` if a coordinate would move by more
/// than 1 mm, as those of survey frames do, millions of metres from their origin.
Eigen::Vector3f round_point(const std::string& name, const Eigen::Vector3d& point);

}  // namespace odosplat
