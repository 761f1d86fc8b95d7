// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// EuRoC's tables of true poses (Burri et al., IJRR 2016), comma separated, times in whole nanoseconds:
///   17 values   state_groundtruth_estimate0/data.csv: time, position, quaternion w x y z, velocity, biases
///    8 values   vicon0/data.csv and tables of the same form: time, position, quaternion w x y z
/// They contain the pose of the body (the IMU), not of a camera.

/// True if the first line of values belongs to such a table. TUM's format with commas has 8 values too: a table with 8
/// values is taken as EuRoC's if its heading contains [ns], or if its times are whole numbers of 16 digits or more.
bool is_euroc_csv(std::string_view text);

/// The poses, with times in seconds and stamps to the nanosecond. If a heading names the quaternion's components, their
/// order is that of the heading. Throws InputError(name, "line N", fault) for a line with another number of values, a
/// value that is not a finite number, a quaternion of length zero, a time that is not a whole number or is before the
/// previous one.
Trajectory parse_euroc_csv(const std::string& name, std::string_view text);

}  // namespace odosplat
