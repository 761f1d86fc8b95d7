// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/similarity.hpp"

namespace odosplat {

/// "s tx ty tz qx qy qz qw": p_target = s * (R(q) * p_source) + t. Lines that start with # are skipped, the eight
/// numbers may be on one line or several, the quaternion of any length but zero. InputError(name, "line N", fault): not
/// eight finite numbers, s <= 0.
Similarity parse_similarity(const std::string& name, const std::string& text);
/// The numbers so that reading gives the same motion to 12 digits, without a line end.
std::string similarity_text(const Similarity& similarity);

/// The same place in two frames.
struct PointPairs {
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
};

/// A pair a line, "x y z X Y Z", source before target; lines that start with # and empty lines are skipped, numbers are
/// separated by blanks. InputError(name, "line N", fault) for another number of values or a value that is no finite
/// number. May be empty.
PointPairs parse_point_pairs(const std::string& name, const std::string& text);

}  // namespace odosplat
