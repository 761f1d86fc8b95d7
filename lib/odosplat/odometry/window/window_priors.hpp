// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <vector>

#include "odosplat/odometry/window/window_optimizer_options.hpp"
#include "odosplat/odometry/window/window_system.hpp"

namespace odosplat {

/// The weak priors that the window's cost contains besides the images and the marginal prior.
struct WindowPriors {
  SE3 oldest;                               // centre of the oldest keyframe's prior
  Vector6d oldest_information;              // its diagonal; 0 if there is a marginal prior
  std::vector<std::optional<SE3>> tracked;  // centre of each keyframe's prior, where it has one
  Vector6d tracked_information;             // its diagonal
  double gain_information;
  double offset_information;
};

WindowPriors make_window_priors(const Window& window, const WindowOptimizerOptions& options);

/// Adds cost and derivatives of the priors of keyframe k: of its pose, its brightness and its anchors'.
void add_keyframe_priors(const WindowState& state, std::size_t k, const WindowPriors& priors, WindowSystem& system);

/// Adds cost and derivatives of these priors and of the window's marginal prior.
void add_window_priors(const Window& window, const WindowState& state, const WindowPriors& priors,
                       WindowSystem& system);

}  // namespace odosplat
