// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A camera pose with its time. time_text is the time as written in the input, kept so that outputs print the same
/// stamp; if it is empty, `time` is printed with 6 decimals.
struct StampedPose {
  double time = 0.0;  // [s]
  SE3 T_world_camera;
  std::string time_text;

  std::string stamp() const {
    if (!time_text.empty()) return time_text;
    char text[64];
    std::snprintf(text, sizeof(text), "%.6f", time);
    return text;
  }
};

/// Poses in ascending order of time.
using Trajectory = std::vector<StampedPose>;

}  // namespace odosplat
