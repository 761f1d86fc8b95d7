// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Two poses of two trajectories with the same time.
struct Match {
  std::size_t estimate = 0;  // indices
  std::size_t truth = 0;
  bool operator==(const Match&) const = default;
};

/// Pairs by time: each pose of the shorter trajectory with the nearest in time of the longer one (of two equally near
/// the earlier), if the difference is at most max_time_difference [s]. The association is one to one: if several poses
/// have the same nearest pose, only the nearest of them is paired (the public tool evo pairs them all). In ascending
/// order of time. Throws InputError if the times of a trajectory are not ascending. Empty input gives no pairs.
std::vector<Match> associate(const Trajectory& estimate, const Trajectory& truth, double max_time_difference);

/// The number of frames that a camera with the estimate's frame rate would have taken while the truth was recorded. The
/// frame interval is the 10th percentile of the estimate's time steps, so that single missing frames do not make the
/// rate lower; a gap in the truth counts as one frame. If the truth has one pose per frame, the result is the number of
/// true poses; if the truth has a higher rate than the images, it is lower. An estimate that leaves out frames
/// regularly (keyframes only) cannot be distinguished from that of a slower camera. With fewer than two estimates the
/// result is the number of true poses.
std::size_t expected_frames(const Trajectory& estimate, const Trajectory& truth);

}  // namespace odosplat
