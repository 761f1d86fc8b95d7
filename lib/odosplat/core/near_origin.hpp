// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Throws InputError naming `name` if the positions lie so far from the origin that single precision, in which maps,
/// clouds and devices keep coordinates, would be too coarse. Example: survey frames (UTM), where single precision
/// resolves coordinates of millions of metres only to 0.5 m. The condition, for the median of a coordinate: half of its
/// distance to the next float is
///   - more than 1 mm (beyond 32 km from the origin), and
///   - more than 1e-5 of the positions' interquartile range (the largest of the three axes). This accepts positions
///     that are widely spread and not only far away, such as a model in millimetres or a drive of 100 km.
/// Medians, so that a stray position has no effect and a few positions at the origin do not hide the others. An empty
/// list passes. Throws InputError for positions that are not finite as well.
void require_near_origin(const std::string& name, const std::vector<Eigen::Vector3d>& positions);
void require_near_origin(const std::string& name, const Trajectory& poses);

}  // namespace odosplat
