// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <vector>

#include "odosplat/odometry/keyframe/keyframe.hpp"
#include "odosplat/odometry/window/marginal_prior.hpp"

namespace odosplat {

struct WindowOptions {
  int max_keyframes = 7;
  double min_visible = 0.05;  // share of a keyframe's points that the newest must see for it to stay

  void check() const;
};

/// The keyframes that are adjusted together, oldest first, and the information left of removed ones.
struct Window {
  std::vector<std::shared_ptr<Keyframe>> keyframes;
  MarginalPrior prior;  // of some of the keyframes
};

/// The window moved as a whole: p_new = p + by.
void translate(Window& window, const Eigen::Vector3d& by);

/// Index of the keyframe that should leave before another is added, or -1 while there is room. The two newest stay.
/// Source: DSO, section 3.1: first one that the newest hardly sees; else the one of the largest distance score
/// sqrt(d(i, newest)) sum_j 1 / (d(i, j) + eps), which keeps keyframes well spread with more near the newest.
int keyframe_to_drop(const Window& window, const Camera& camera, const WindowOptions& options);

}  // namespace odosplat
