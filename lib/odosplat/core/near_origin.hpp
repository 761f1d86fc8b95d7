// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// InputError naming `name` if positions lie so far from the origin that single precision, which maps, clouds and
/// devices keep coordinates in, would spoil them: as those of survey frames (UTM), whose millions of metres go by steps
/// of 0.5 m. Told by a coordinate's median: half of its step is more than 1 mm (beyond 32 km from the origin) and more
/// than a hundred thousandth of the spread of the middle half of the positions. The second lets pass what is large and
/// not far off, such as a model in millimetres or a drive of 100 km; medians, that a stray position does not count, and
/// that a few at the origin do not hide the others. None: fine. Throws for positions that are not finite as well.
void require_near_origin(const std::string& name, const std::vector<Eigen::Vector3d>& positions);
void require_near_origin(const std::string& name, const Trajectory& poses);

}  // namespace odosplat
