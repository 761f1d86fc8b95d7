// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/camera/camera.hpp"
#include "odosplat/odometry/window/photometric_pair.hpp"
#include "odosplat/odometry/window/window.hpp"

namespace odosplat {

struct ActivationOptions {
  int active_points = 2000;        // of the whole window, the map's and others, that are seen by the newest keyframe
  double max_length = 8.0;         // [px] of an interval that is narrow enough
  double min_quality = 3.0;        // second-best cost over best of the last match
  double min_information = 400.0;  // [m^2] of inverse depth, over all keyframes: 0.05 /m
  int iterations = 3;              // of Gauss-Newton on the point's inverse depth alone

  void check() const;
};

/// Makes points of the window's immature ones: those whose interval is narrow, whose match was distinct, and which fall
/// where the newest keyframe has no point yet (a grid over its image, as fine as active_points are dense). Their
/// inverse depth is refined in all keyframes first; what then agrees with none, or with fewer than it contradicts, is
/// dropped. Source: DSO, section 3.2, with a grid in place of the distance map. The points go to their own keyframe,
/// without prior. Immature points that the newest keyframe cannot see stay. Returns how many were made.
int activate_points(Window& window, const Camera& camera, const PhotometricOptions& photometric,
                    const ActivationOptions& options);

/// Removes estimated points that lie behind their camera or are contradicted by more keyframes than agree. Counts must
/// be those of the last adjustment.
void remove_bad_points(Window& window, const Camera& camera);

}  // namespace odosplat
