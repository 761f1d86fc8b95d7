// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/window_priors.hpp"

namespace odosplat {
namespace {

double information(double sigma) { return 1.0 / (sigma * sigma); }

Vector6d pose_information(double translation, double rotation) {
  Vector6d diagonal;
  diagonal << Eigen::Vector3d::Constant(information(translation)), Eigen::Vector3d::Constant(information(rotation));
  return diagonal;
}

void add(WindowSystem& system, Eigen::Index i, double value, double weight) {
  system.H(i, i) += weight;
  system.g[i] += weight * value;
  system.cost += 0.5 * weight * value * value;
}

/// Left Jacobian of log taken as identity: these priors are weak and their argument small.
void add_pose(WindowSystem& system, std::size_t k, const SE3& T_world_camera, const SE3& center,
              const Vector6d& information) {
  const Vector6d drift = (T_world_camera * center.inverse()).log();
  for (Eigen::Index i = 0; i < 6; ++i) add(system, static_cast<Eigen::Index>(8 * k) + i, drift[i], information[i]);
}

}  // namespace

WindowPriors make_window_priors(const Window& window, const WindowOptimizerOptions& options) {
  WindowPriors priors;
  priors.oldest = window.keyframes.front()->T_world_camera;
  priors.oldest_information.setZero();
  if (window.prior.empty()) {
    priors.oldest_information = pose_information(options.gauge_translation, options.gauge_rotation);
  }
  for (const auto& keyframe : window.keyframes) priors.tracked.push_back(keyframe->T_world_tracked);
  priors.tracked_information = pose_information(options.tracked_translation, options.tracked_rotation);
  priors.gain_information = information(options.gain_sigma);
  priors.offset_information = information(options.offset_sigma);
  return priors;
}

void add_keyframe_priors(const WindowState& state, std::size_t k, const WindowPriors& priors, WindowSystem& system) {
  if (priors.tracked[k]) {
    add_pose(system, k, state.poses[k].T_world_camera, *priors.tracked[k], priors.tracked_information);
  }
  const auto brightness = static_cast<Eigen::Index>(8 * k + 6);
  add(system, brightness, state.brightness[k].a, priors.gain_information);
  add(system, brightness + 1, state.brightness[k].b, priors.offset_information);
  Eigen::Index column = state.anchor_column(k);
  for (const Brightness& anchor : state.anchors[k]) {
    add(system, column++, anchor.a, priors.gain_information);
    add(system, column++, anchor.b, priors.offset_information);
  }
}

void add_window_priors(const Window& window, const WindowState& state, const WindowPriors& priors,
                       WindowSystem& system) {
  add_pose(system, 0, state.poses[0].T_world_camera, priors.oldest, priors.oldest_information);
  for (std::size_t k = 0; k < state.poses.size(); ++k) add_keyframe_priors(state, k, priors, system);
  add_marginal_prior(window, state, system);
}

}  // namespace odosplat
