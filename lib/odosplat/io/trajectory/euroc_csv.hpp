// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// EuRoC's tables of true poses (Burri et al., IJRR 2016), comma separated, times in whole nanoseconds:
///   17 values   state_groundtruth_estimate0/data.csv: time, position, quaternion w x y z, velocity, biases
///    8 values   vicon0/data.csv and tables made like it: time, position, quaternion w x y z
/// They give the pose of the body (the IMU), not of a camera.

/// True if the first line of values is of such a table. TUM's format with commas has 8 values too: a table of 8 is
/// EuRoC's if its heading says [ns], or if its times are whole numbers of 16 digits or more.
bool is_euroc_csv(std::string_view text);

/// The poses, times in seconds, stamps to the nanosecond. Where a heading names the quaternion's parts, their order is
/// the heading's. InputError(name, "line N", fault) for a line of another number of values, a value that is no finite
/// number, a quaternion of length zero, a time that is no whole number or goes back.
Trajectory parse_euroc_csv(const std::string& name, std::string_view text);

}  // namespace odosplat
