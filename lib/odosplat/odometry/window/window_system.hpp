// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/odometry/window/depth_elimination.hpp"
#include "odosplat/odometry/window/photometric_pair.hpp"
#include "odosplat/odometry/window/window.hpp"

namespace odosplat {

/// The values of everything that an adjustment of a window changes.
struct WindowState {
  std::vector<PoseEstimate> poses;               // one per keyframe
  std::vector<Brightness> brightness;            // one per keyframe
  std::vector<std::vector<Brightness>> anchors;  // of a keyframe's anchors
  std::vector<std::vector<double>> offsets;      // [1/m] of all points of a keyframe; none where nothing is estimated

  /// Column of the system below where the brightness of keyframe k's first anchor begins; with k the number of
  /// keyframes, the number of columns.
  Eigen::Index anchor_column(std::size_t k) const;
};

/// Normal equations of a whole window. Parameters: for keyframe k at 8k its pose (6, left perturbation), a, b; then of
/// every anchor, keyframe by keyframe, its a, b. Offsets are kept apart, for each host.
struct WindowSystem {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double cost = 0.0;
  std::vector<HostDepths> depths;                        // one per keyframe
  std::vector<PairSystem> pairs;                         // host-major, n (n - 1) of them; already contained in H and g
  std::vector<std::vector<std::pair<int, int>>> counts;  // of a keyframe's estimated points: agreeing, contradicting
};

/// Poses in the window's prior are linearised where the prior says, others at their current value.
WindowState window_state(const Window& window);

/// Sums the pairs of all keyframes and anchors at the state given, and the offsets' priors. Other priors are not
/// included.
/// only: index of a keyframe, to leave out all pairs and anchors that it has no part in; -1: everything.
/// Runs on several threads; sums in fixed order.
WindowSystem evaluate_window(const Window& window, const WindowState& state, const Camera& camera,
                             const PhotometricOptions& options, int only = -1);

/// Adds the cost and derivatives of the window's marginal prior.
void add_marginal_prior(const Window& window, const WindowState& state, WindowSystem& system);

/// H + damping * diagonal(H) and g with the offsets eliminated, equally damped.
void reduce_system(const WindowSystem& system, double damping, Eigen::MatrixXd& H, Eigen::VectorXd& g);

/// The state after a step of the parameters above and the offsets' steps that belong to it.
WindowState stepped(const WindowState& state, const WindowSystem& system, const Eigen::VectorXd& step, double damping);

}  // namespace odosplat
