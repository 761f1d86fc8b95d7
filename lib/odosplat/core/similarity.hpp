// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A similarity transform from one world frame into another: p_target = scale * (R * p_source) + t.
struct Similarity {
  double scale = 1.0;
  SE3 T_target_source;

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
    return scale * (T_target_source.rotation() * p) + T_target_source.translation();
  }
  /// The pose in the target world of a camera given in the source world: its position is scaled, rotated and shifted,
  /// its orientation rotated.
  SE3 operator*(const SE3& T_source_camera) const {
    return {T_target_source.rotation() * T_source_camera.rotation(), *this * T_source_camera.translation()};
  }
};

/// The similarity (with_scale) or rigid motion that brings source to target with the least sum of squared distances.
/// Source: Umeyama 1991, "Least-squares estimation of transformation parameters between two point patterns", equations
/// 34 to 43; reflections are excluded. Both lists have the same length, any unit. Throws InputError for fewer than
/// three points or points on a line (within about 1e-5 of their extent), which do not determine the rotation.
Similarity align_points(const std::vector<Eigen::Vector3d>& source, const std::vector<Eigen::Vector3d>& target,
                        bool with_scale);

}  // namespace odosplat
