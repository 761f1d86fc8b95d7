// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr double degrees_per_radian = 180.0 / std::numbers::pi;

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
  if (result.pairs == 0) {
    throw InputError("trajectories", "no pose of the estimate (" + std::to_string(estimate.size()) +
                                         ") is of the time of one of the truth (" + std::to_string(truth.size()) +
                                         ") within " + std::to_string(options.max_time_difference) + " s");
  }
  const std::size_t frames = options.frames > 0 ? options.frames : expected_frames(estimate, truth);
  result.coverage =
      std::min(1.0, static_cast<double>(result.pairs) / static_cast<double>(std::max<std::size_t>(frames, 1)));

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
  return result;
}

}  // namespace odosplat
