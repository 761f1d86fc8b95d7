// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/formatted.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A camera pose with its time. time_text is the time as written in the input, kept so that outputs print the same
/// stamp; if it is empty, `time` is printed with 6 decimals.
struct StampedPose {
  double time = 0.0;  // [s]
  SE3 T_world_camera;
  std::string time_text;

  std::string stamp() const { return time_text.empty() ? formatted("%.6f", time) : time_text; }
};

/// Poses in ascending order of time.
using Trajectory = std::vector<StampedPose>;

/// The pose at time t of the motion from one pose to a later one (interpolate); beyond them it is extrapolated.
inline SE3 pose_between(const StampedPose& before, const StampedPose& after, double t) {
  return interpolate(before.T_world_camera, after.T_world_camera, (t - before.time) / (after.time - before.time));
}

}  // namespace odosplat
