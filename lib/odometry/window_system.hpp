// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/core/camera.hpp"
#include "odosplat/odometry/photometric_pair.hpp"
#include "odosplat/odometry/window.hpp"

namespace odosplat {

/// Poses and brightness of a window at one moment of its adjustment.
struct WindowState {
  std::vector<SE3> poses;              // T_world_camera, a keyframe each
  std::vector<Brightness> brightness;  // a keyframe each
  std::vector<Brightness> anchors;     // a keyframe each, whether it has an anchor or not
};

/// Normal equations of a whole window. Parameters: for keyframe k at 8k its pose (6, left perturbation), a, b; then for
/// keyframe k at 8n + 2k its anchor's a, b.
struct WindowSystem {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double cost = 0.0;
  std::vector<PairSystem> pairs;    // host-major, n (n - 1) of them
  std::vector<PairSystem> anchors;  // a keyframe each
};

WindowState window_state(const Window& window);

/// Sums the pairs of all keyframes and anchors at the state given. Priors are not in it.
WindowSystem evaluate_window(const Window& window, const WindowState& state, const Camera& camera,
                             const PhotometricOptions& options);

}  // namespace odosplat
