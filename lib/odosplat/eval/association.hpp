// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Poses of two trajectories that are of the same time.
struct Match {
  std::size_t estimate = 0;  // indices
  std::size_t truth = 0;
  bool operator==(const Match&) const = default;
};

/// Pairs by time: each pose of the shorter trajectory with the nearest in time of the longer one, if that is no more
/// than max_time_difference [s] away (of two equally near the earlier). One to one: where several want the same pose
/// the nearest gets it, the others stay alone (here the public tool evo pairs them all). In ascending order of time;
/// times of both must be ascending, else InputError. Empty input gives no pairs.
std::vector<Match> associate(const Trajectory& estimate, const Trajectory& truth, double max_time_difference);

/// How many frames a camera with the estimate's frame rate would have taken while the truth was recorded. The rate is
/// that of the shortest tenth of the estimate's time steps, so that frames left out do not count as a slower camera; a
/// gap in the truth counts as one frame. With one truth a frame this is the number of true poses; with truth recorded
/// faster than the images it is fewer. An estimate that leaves out frames regularly (keyframes only) looks like a
/// slower camera. Fewer than two estimates: the number of true poses.
std::size_t expected_frames(const Trajectory& estimate, const Trajectory& truth);

}  // namespace odosplat
