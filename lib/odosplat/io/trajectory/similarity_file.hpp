// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/similarity.hpp"

namespace odosplat {

/// "s tx ty tz qx qy qz qw": p_target = s * (R(q) * p_source) + t. Lines that start with # are skipped; the eight
/// numbers may be on one line or several; the quaternion may have any length but zero. Throws InputError(name, "line
/// N", fault): not eight finite numbers, s <= 0.
Similarity parse_similarity(const std::string& name, const std::string& text);
/// The eight numbers with 12 significant digits, without a line end.
std::string similarity_text(const Similarity& similarity);

/// Corresponding points in two frames: source[i] and target[i] are the same place.
struct PointPairs {
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
};

/// One pair per line, "x y z X Y Z", source before target; lines that start with # and empty lines are skipped, numbers
/// are separated by blanks. Throws InputError(name, "line N", fault) for another number of values or a value that is
/// not a finite number. The result may be empty.
PointPairs parse_point_pairs(const std::string& name, const std::string& text);

}  // namespace odosplat
