// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

#include "odosplat/eval/statistics.hpp"
#include "tests/accuracy/play.hpp"

namespace odosplat::accuracy {

/// Errors of some steps of a run. Blind steps are not evaluated and do not count as lost.
struct Judged {
  Statistics ate_m;       // of the final estimate
  Statistics live_ate_m;  // of the poses reported live, before later refinement
  Statistics rte_m;       // of the final estimate, between consecutive frames
  Statistics rre_deg;
  std::size_t frames = 0;
  std::size_t lost = 0;
  double lost_share() const { return frames > 0 ? static_cast<double>(lost) / static_cast<double>(frames) : 0.0; }
};

/// Evaluates steps begin to end - 1 of a run. Only the counts are set if no frame has a pose.
Judged judge(const Run& run, std::size_t begin, std::size_t end);
Judged judge(const Run& run);

/// Difference of a live pose from the true one.
struct PoseError {
  double meters = 0.0;
  double degrees = 0.0;
};
PoseError pose_error(const PlayedFrame& frame);

/// Normalised pose error squared: xi^T C^-1 xi with T_true = exp(xi) T_estimate, C the covariance of xi. If the
/// covariance is correct, it follows a chi-squared distribution with 6 degrees of freedom: mean 6, 1 % above 16.8.
/// Source: Bar-Shalom, Li, Kirubarajan 2001, section 5.4. Infinite if C is not positive definite.
double normalised_error_squared(const SE3& T_world_camera, const SE3& T_world_camera_true, const Matrix6d& covariance);

/// Normalised errors of a run's live poses. The first frame, whose pose was given, is left out.
struct Consistency {
  Statistics all;
  Statistics keyframes;
  Statistics between;       // frames that are not keyframes
  Statistics beyond;        // poses that are not in the map
  double above_99 = 0.0;    // share above 16.8; 0.01 expected
  double below_median = 0;  // share below 5.35; 0.5 expected
};
Consistency consistency(const Run& run);

/// Thresholds for a recovered pose and for a wrong pose.
struct RecoveryBars {
  double meters = 0.02;    // largest position error of a recovered pose
  double degrees = 1.0;    // and its largest rotation error
  int hold = 15;           // number of consecutive frames within both limits, or fewer if the evaluated range ends
  double wrong_m = 0.1;    // a pose with a larger position error
  double wrong_deg = 5.0;  // or a larger rotation error is wrong
};

/// Number of frames from step `from` to the first step before `end` that is recovered as defined above; -1: none.
int frames_until_recovered(const Run& run, std::size_t from, std::size_t end, const RecoveryBars& bars);
/// Number of poses reported as in the map that are wrong, or of blind steps, which have no correct pose.
int wrong_in_map(const Run& run, const RecoveryBars& bars);
/// Number of wrong poses among steps begin to end - 1.
int wrong_poses(const Run& run, std::size_t begin, std::size_t end, const RecoveryBars& bars);

}  // namespace odosplat::accuracy
