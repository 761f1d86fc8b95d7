// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

#include "odosplat/eval/statistics.hpp"
#include "tests/accuracy/play.hpp"

namespace odosplat::accuracy {

/// Errors of some steps of a run. Blind steps are not judged, and do not count as lost.
struct Judged {
  Statistics ate_m;       // of the final estimate
  Statistics live_ate_m;  // of the poses as they were when the frames came
  Statistics rte_m;       // of the final estimate, from frame to frame
  Statistics rre_deg;
  std::size_t frames = 0;
  std::size_t lost = 0;
  double lost_share() const { return frames > 0 ? static_cast<double>(lost) / static_cast<double>(frames) : 0.0; }
};

/// Judges steps begin to end - 1 of a run. All zeros but the counts if no frame has a pose.
Judged judge(const Run& run, std::size_t begin, std::size_t end);
Judged judge(const Run& run);

/// How far a live pose is from the truth.
struct PoseError {
  double meters = 0.0;
  double degrees = 0.0;
};
PoseError pose_error(const PlayedFrame& frame);

/// Normalised pose error squared: xi^T C^-1 xi with T_true = exp(xi) T_estimate, C the covariance of xi. Of a
/// covariance that is right it is distributed as chi squared with 6 degrees of freedom: mean 6, one in a hundred
/// above 16.8. Source: Bar-Shalom, Li, Kirubarajan 2001, section 5.4. Infinite where C is not positive definite.
double normalised_error_squared(const SE3& T_world_camera, const SE3& T_world_camera_true, const Matrix6d& covariance);

/// Normalised errors of a run's live poses. The first frame, whose pose was given, is left out.
struct Consistency {
  Statistics all;
  Statistics keyframes;
  Statistics between;       // frames that are no keyframes
  double above_99 = 0.0;    // share above 16.8; 0.01 expected
  double below_median = 0;  // share below 5.35; 0.5 expected
};
Consistency consistency(const Run& run);

/// When a camera is where it should be, and when a pose is plainly wrong.
struct RecoveryBars {
  double meters = 0.02;    // at most this far from the truth
  double degrees = 1.0;    // and turned by at most this
  int hold = 15;           // frames for which that must hold from then on, or to the end of what is looked at
  double wrong_m = 0.1;    // a pose further off, or
  double wrong_deg = 5.0;  // turned further, is a wrong pose
};

/// Frames from step `from` to the first before step `end` that is within the bars and stays so; -1: none.
int frames_until_recovered(const Run& run, std::size_t from, std::size_t end, const RecoveryBars& bars);
/// Poses among steps begin to end - 1 that are plainly wrong.
int wrong_poses(const Run& run, std::size_t begin, std::size_t end, const RecoveryBars& bars);

}  // namespace odosplat::accuracy
