// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// How an estimate is laid over the truth before it is judged: as it is, by a rigid motion, or with a scale as well.
enum class TrajectoryAlignment { none, se3, sim3 };

/// "none", "se3", "sim3"; throws InputError for another word.
TrajectoryAlignment alignment_from_name(const std::string& name);
std::string alignment_name(TrajectoryAlignment alignment);

/// p_target = scale * (R * p_source) + t.
struct Similarity {
  double scale = 1.0;
  SE3 T_target_source;

  Eigen::Vector3d operator*(const Eigen::Vector3d& p) const {
    return scale * (T_target_source.rotation() * p) + T_target_source.translation();
  }
};

/// The similarity (with_scale) or rigid motion that brings source to target with the least sum of squared distances.
/// Source: Umeyama 1991, "Least-squares estimation of transformation parameters between two point patterns", equations
/// 34 to 43; reflections are excluded. Both lists of the same length, any unit. Throws InputError for fewer than three
/// points or points on a line (within about 1e-5 of their extent): the rotation is not determined then.
Similarity align_points(const std::vector<Eigen::Vector3d>& source, const std::vector<Eigen::Vector3d>& target,
                        bool with_scale);

}  // namespace odosplat
