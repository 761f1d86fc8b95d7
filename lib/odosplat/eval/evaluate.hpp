// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/similarity.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/eval/alignment.hpp"
#include "odosplat/eval/association.hpp"
#include "odosplat/eval/statistics.hpp"

namespace odosplat {

struct EvalOptions {
  TrajectoryAlignment alignment = TrajectoryAlignment::none;
  int delta = 1;                      // [frames] distance of the two poses of a relative error, in matched poses
  bool all_pairs = false;             // relative errors start at every pose, not only at 0, delta, 2 delta, ...
  double max_time_difference = 0.01;  // [s] between matched poses
  std::size_t frames = 0;             // number of frames that should have been estimated; 0: expected_frames()

  void check() const;
};

struct EvalResult {
  Statistics ate_m;    // absolute trajectory error: distance of the positions
  Statistics are_deg;  // absolute rotation error
  Statistics rte_m;    // relative translation error over delta frames; empty if there are fewer matched poses
  Statistics rre_deg;  // relative rotation error over delta frames
  std::size_t pairs = 0;
  double coverage = 0.0;           // the smaller of the next two
  double coverage_estimate = 0.0;  // pairs / poses of the estimate
  double coverage_truth = 0.0;     // pairs / frames, 1 at most
  std::string doubt;               // one line with the cause if less than half of the estimate is matched, else empty
  TrajectoryAlignment alignment = TrajectoryAlignment::none;
  Similarity truth_from_estimate;  // the alignment that was applied; its scale is 1 unless sim3
  std::vector<Match> matches;
  std::vector<double> position_errors_m;  // one per match
};

/// No pose of the estimate matches a pose of the truth in time, or less than half of the estimate matches and too few
/// poses for the alignment. The message gives the likely cause.
class NothingMatched : public InputError {
 public:
  using InputError::InputError;
};

/// Errors of an estimated trajectory against the true one. Both give T_world_camera [m]; only matched poses count.
/// Source: Sturm et al. 2012, "A benchmark for the evaluation of RGB-D SLAM systems", section V, with the conventions
/// of the public tool evo, which gives the same figures: ATE is the error of the position (its `trans_part`); the
/// relative error of poses i and j is (Q_i^-1 Q_j)^-1 (P_i^-1 P_j) with truth Q and estimate P; consecutive pairs do
/// not overlap unless all_pairs. Differences: association is one to one, and coverage gives the share of estimate and
/// truth that was compared. If less than half of the estimate is matched, the number of frames cannot be derived from
/// its rate, and every true pose counts as a frame. Throws NothingMatched if no poses match (or less than half, and too
/// few to align), InputError if the requested alignment is not determined.
EvalResult evaluate(const Trajectory& estimate, const Trajectory& truth, const EvalOptions& options);

}  // namespace odosplat
