// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/stamp_guess.hpp"

namespace odosplat {
namespace {

Similarity find_alignment(const std::vector<SE3>& estimate, const std::vector<SE3>& truth,
                          TrajectoryAlignment alignment) {
  if (alignment == TrajectoryAlignment::none) return {};
  std::vector<Eigen::Vector3d> source;
  std::vector<Eigen::Vector3d> target;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    source.push_back(estimate[i].translation());
    target.push_back(truth[i].translation());
  }
  return align_points(source, target, alignment == TrajectoryAlignment::sim3);
}

void check_finite(const Trajectory& trajectory, const char* name) {
  for (std::size_t i = 0; i < trajectory.size(); ++i) {
    if (!trajectory[i].T_world_camera.is_finite()) {
      throw InputError(name, "pose " + std::to_string(i), "is not finite");
    }
  }
}

NamedStamps stamps_of(const Trajectory& trajectory, const char* name) {
  NamedStamps stamps{name, {}};
  for (const StampedPose& pose : trajectory) stamps.times.push_back(pose.time);
  return stamps;
}

std::string why_unmatched(const Trajectory& estimate, const Trajectory& truth, const EvalResult& result,
                          double tolerance) {
  if (2 * result.pairs >= truth.size() && result.pairs > 1) {
    return "the truth has few poses (" + std::to_string(truth.size()) + ")";
  }
  return guess_stamp_fault(stamps_of(estimate, "the estimate"), stamps_of(truth, "the truth"), tolerance);
}

}  // namespace

void EvalOptions::check() const {
  require(delta >= 1, "delta", "at least 1 frame");
  require(std::isfinite(max_time_difference) && max_time_difference >= 0.0, "max_time_difference", "at least 0 [s]");
}

EvalResult evaluate(const Trajectory& estimate, const Trajectory& truth, const EvalOptions& options) {
  options.check();
  check_finite(estimate, "estimate");
  check_finite(truth, "truth");
  EvalResult result;
  result.matches = associate(estimate, truth, options.max_time_difference);
  result.pairs = result.matches.size();
  result.alignment = options.alignment;
  const bool under_half = 2 * result.pairs < estimate.size();
  if (result.pairs == 0 || under_half) {
    const std::string why = why_unmatched(estimate, truth, result, options.max_time_difference);
    result.doubt = std::to_string(result.pairs) + " of " + std::to_string(estimate.size()) +
                   " poses of the estimate match one of the truth in time (" + std::to_string(truth.size()) +
                   ") within " + number_text(options.max_time_difference) + " s" + (why.empty() ? "" : "; " + why);
  }
  const bool alignable = options.alignment == TrajectoryAlignment::none || result.pairs >= 3;
  if (result.pairs == 0 || (under_half && !alignable)) throw NothingMatched("trajectories", result.doubt);
  const std::size_t frames = options.frames > 0 ? options.frames
                             : under_half       ? truth.size()
                                                : expected_frames(estimate, truth);
  const auto pairs = static_cast<double>(result.pairs);
  result.coverage_truth = std::min(1.0, pairs / static_cast<double>(std::max<std::size_t>(frames, 1)));
  result.coverage_estimate = pairs / static_cast<double>(estimate.size());
  result.coverage = std::min(result.coverage_truth, result.coverage_estimate);

  std::vector<SE3> estimates;
  std::vector<SE3> truths;
  for (const Match& match : result.matches) {
    estimates.push_back(estimate[match.estimate].T_world_camera);
    truths.push_back(truth[match.truth].T_world_camera);
  }
  result.truth_from_estimate = find_alignment(estimates, truths, options.alignment);
  const Similarity& S = result.truth_from_estimate;
  for (SE3& T : estimates) T = S * T;

  std::vector<double> rotation_errors;
  for (std::size_t i = 0; i < result.pairs; ++i) {
    result.position_errors_m.push_back((estimates[i].translation() - truths[i].translation()).norm());
    rotation_errors.push_back((truths[i].inverse() * estimates[i]).angle() * degrees_per_radian);
  }
  result.ate_m = statistics(result.position_errors_m);
  result.are_deg = statistics(rotation_errors);

  std::vector<double> relative_translations;
  std::vector<double> relative_rotations;
  const auto delta = static_cast<std::size_t>(options.delta);
  const std::size_t step = options.all_pairs ? 1 : delta;
  for (std::size_t i = 0; i + delta < result.pairs; i += step) {
    const SE3 truth_motion = truths[i].inverse() * truths[i + delta];
    const SE3 estimated_motion = estimates[i].inverse() * estimates[i + delta];
    const SE3 error = truth_motion.inverse() * estimated_motion;
    relative_translations.push_back(error.translation().norm());
    relative_rotations.push_back(error.angle() * degrees_per_radian);
  }
  result.rte_m = statistics(relative_translations);
  result.rre_deg = statistics(relative_rotations);
  for (const Statistics* s : {&result.ate_m, &result.are_deg, &result.rte_m, &result.rre_deg}) {
    if (s->count > 0 && !(std::isfinite(s->rmse) && std::isfinite(s->max))) {
      throw InputError("trajectories", "positions are so large that their errors overflow");
    }
  }
  return result;
}

}  // namespace odosplat
