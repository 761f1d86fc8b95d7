// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window_priors.hpp"

namespace odosplat {
namespace {

double information(double sigma) { return 1.0 / (sigma * sigma); }

void add(WindowSystem& system, Eigen::Index i, double value, double weight) {
  system.H(i, i) += weight;
  system.g[i] += weight * value;
  system.cost += 0.5 * weight * value * value;
}

}  // namespace

WindowPriors make_window_priors(const Window& window, const WindowOptimizerOptions& options) {
  WindowPriors priors;
  priors.oldest = window.keyframes.front()->T_world_camera;
  priors.oldest_information.setZero();
  if (window.prior.empty()) {
    priors.oldest_information << Eigen::Vector3d::Constant(information(options.gauge_translation)),
        Eigen::Vector3d::Constant(information(options.gauge_rotation));
  }
  priors.gain_information = information(options.gain_sigma);
  priors.offset_information = information(options.offset_sigma);
  return priors;
}

void add_brightness_priors(const WindowState& state, std::size_t k, const WindowPriors& priors, WindowSystem& system) {
  const auto brightness = static_cast<Eigen::Index>(8 * k + 6);
  const auto anchor = static_cast<Eigen::Index>(8 * state.poses.size() + 2 * k);
  add(system, brightness, state.brightness[k].a, priors.gain_information);
  add(system, brightness + 1, state.brightness[k].b, priors.offset_information);
  add(system, anchor, state.anchors[k].a, priors.gain_information);
  add(system, anchor + 1, state.anchors[k].b, priors.offset_information);
}

void add_window_priors(const Window& window, const WindowState& state, const WindowPriors& priors,
                       WindowSystem& system) {
  // Left Jacobian of log taken as identity: the prior is weak and its argument small.
  const Vector6d drift = (state.poses[0].T_world_camera * priors.oldest.inverse()).log();
  for (Eigen::Index i = 0; i < 6; ++i) add(system, i, drift[i], priors.oldest_information[i]);
  for (std::size_t k = 0; k < state.poses.size(); ++k) add_brightness_priors(state, k, priors, system);
  add_marginal_prior(window, state, system);
}

}  // namespace odosplat
