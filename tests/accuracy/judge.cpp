// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/judge.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numbers>

#include "odosplat/eval/evaluate.hpp"

namespace odosplat::accuracy {
namespace {

constexpr double chi_squared_6_median = 5.348;
constexpr double chi_squared_6_99 = 16.812;

bool posed(const PlayedFrame& frame) { return frame.result.status != TrackStatus::lost; }

}  // namespace

PoseError pose_error(const PlayedFrame& frame) {
  const SE3 error = frame.T_world_camera_true.inverse() * frame.result.T_world_camera;
  return {error.translation().norm(), error.angle() * 180.0 / std::numbers::pi};
}

Judged judge(const Run& run, std::size_t begin, std::size_t end) {
  Judged judged;
  Trajectory truth;
  std::vector<double> live;
  for (std::size_t k = begin; k < end; ++k) {
    const PlayedFrame& frame = run.frames[k];
    if (frame.blind) continue;
    ++judged.frames;
    truth.push_back({frame.time, frame.T_world_camera_true, ""});
    if (posed(frame)) {
      live.push_back(pose_error(frame).meters);
    } else {
      ++judged.lost;
    }
  }
  judged.live_ate_m = statistics(live);
  Trajectory estimate;
  std::size_t k = 0;
  for (const StampedPose& pose : run.trajectory) {
    while (k < truth.size() && truth[k].time < pose.time) ++k;
    if (k < truth.size() && truth[k].time == pose.time) estimate.push_back(pose);
  }
  if (estimate.empty()) return judged;
  EvalOptions options;
  options.max_time_difference = 1e-9;
  const EvalResult result = evaluate(estimate, truth, options);
  judged.ate_m = result.ate_m;
  judged.rte_m = result.rte_m;
  judged.rre_deg = result.rre_deg;
  return judged;
}

Judged judge(const Run& run) { return judge(run, 0, run.frames.size()); }

double normalised_error_squared(const SE3& T_world_camera, const SE3& T_world_camera_true, const Matrix6d& covariance) {
  const Vector6d xi = (T_world_camera_true * T_world_camera.inverse()).log();
  // The variances of metres and radians may differ by many orders of magnitude: the matrix is scaled to a unit diagonal
  // before it is factorised.
  const Vector6d scale = covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
  if (!(scale.minCoeff() > 0.0)) return std::numeric_limits<double>::infinity();
  const Vector6d inverse = scale.cwiseInverse();
  const Eigen::LLT<Matrix6d> factor(Matrix6d(inverse.asDiagonal() * covariance * inverse.asDiagonal()));
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  return factor.matrixL().solve(Vector6d(inverse.asDiagonal() * xi)).squaredNorm();
}

Consistency consistency(const Run& run) {
  std::vector<double> all;
  std::vector<double> keyframes;
  std::vector<double> between;
  std::vector<double> beyond;
  for (std::size_t k = 1; k < run.frames.size(); ++k) {
    const PlayedFrame& frame = run.frames[k];
    if (frame.blind || !posed(frame)) continue;
    const double nees =
        normalised_error_squared(frame.result.T_world_camera, frame.T_world_camera_true, frame.result.covariance);
    all.push_back(nees);
    (frame.result.keyframe ? keyframes : between).push_back(nees);
    if (!frame.result.in_map) beyond.push_back(nees);
  }
  Consistency result;
  result.all = statistics(all);
  result.keyframes = statistics(keyframes);
  result.between = statistics(between);
  result.beyond = statistics(beyond);
  const auto share = [&all](auto&& holds) {
    return static_cast<double>(std::count_if(all.begin(), all.end(), holds)) /
           static_cast<double>(std::max<std::size_t>(1, all.size()));
  };
  result.above_99 = share([](double nees) { return nees > chi_squared_6_99; });
  result.below_median = share([](double nees) { return nees < chi_squared_6_median; });
  return result;
}

int frames_until_recovered(const Run& run, std::size_t from, std::size_t end, const RecoveryBars& bars) {
  end = std::min(end, run.frames.size());
  const auto good = [&](const PlayedFrame& frame) {
    if (!posed(frame)) return false;
    const PoseError error = pose_error(frame);
    return error.meters <= bars.meters && error.degrees <= bars.degrees;
  };
  for (std::size_t k = from; k < end; ++k) {
    const std::size_t held = std::min(end, k + static_cast<std::size_t>(std::max(1, bars.hold)));
    std::size_t j = k;
    while (j < held && good(run.frames[j])) ++j;
    if (j == held) return static_cast<int>(k - from);
    k = j;
  }
  return -1;
}

int wrong_in_map(const Run& run, const RecoveryBars& bars) {
  return static_cast<int>(std::count_if(run.frames.begin(), run.frames.end(), [&](const PlayedFrame& frame) {
    if (frame.result.status == TrackStatus::lost || !frame.result.in_map) return false;
    const PoseError error = pose_error(frame);
    return frame.blind || error.meters > bars.wrong_m || error.degrees > bars.wrong_deg;
  }));
}

int wrong_poses(const Run& run, std::size_t begin, std::size_t end, const RecoveryBars& bars) {
  int wrong = 0;
  for (std::size_t k = begin; k < std::min(end, run.frames.size()); ++k) {
    if (!posed(run.frames[k])) continue;
    const PoseError error = pose_error(run.frames[k]);
    if (error.meters > bars.wrong_m || error.degrees > bars.wrong_deg) ++wrong;
  }
  return wrong;
}

}  // namespace odosplat::accuracy
