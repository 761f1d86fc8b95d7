// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"

/// Readers of the tables that `track` writes beside its trajectories.
namespace odosplat::apps {

/// A row of status.csv.
struct StatusRow {
  double time = 0.0;   // [s]
  std::string status;  // ok, relocalised, lost
  bool keyframe = false;
  bool in_map = false;
  double confirmed = std::numeric_limits<double>::quiet_NaN();  // probability; NaN: not compared
  std::string reason;                                           // of a lost frame
};

/// Columns are found by their names in the heading. InputError naming file, line and fault: a missing column `time`,
/// `status` or `in_map`, a row with another number of values, a time that is no number or is before the previous one,
/// another status.
std::vector<StatusRow> parse_status_table(const std::string& name, const std::string& text);

/// Standard deviations of a pose.
struct PoseSigma {
  double time = 0.0;          // [s]
  double position_m = 0.0;    // root of the trace of the covariance of the camera's position
  double rotation_deg = 0.0;  // root of the trace of that of its rotation
};

/// Of the rows of covariance.csv that belong to a pose of `poses` (same time within 1e-6 s): the covariance is that of a
/// perturbation on the left, so the camera's position moves by the translation and by the rotation around the world's
/// origin. InputError naming file, line and fault: not 22 numbers, a time before the previous one.
std::vector<PoseSigma> parse_covariance_table(const std::string& name, const std::string& text,
                                              const Trajectory& poses);

}  // namespace odosplat::apps
