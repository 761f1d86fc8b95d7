// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <span>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/keyframe.hpp"
#include "odosplat/odometry/pixel_selector.hpp"

namespace odosplat {

struct WindowPointOptions {
  int points = 350;                     // wanted of a keyframe, for the window's adjustment
  int anchor_points = 700;              // wanted of a rendered view
  double gradient_weight = 50.0 / 255;  // [grey/px] c of the weight c^2 / (c^2 + |gradient|^2)
  double min_alpha = 0.9;               // a rendered pixel must be covered this much to serve as anchor

  void check() const;
};

/// Points of an image seen from T_world_host with the depth of `view`, which must have been rendered from that pose.
/// gradients: of the host's image, full size first. Pixels whose pattern leaves the image, without trusted depth, or
/// with alpha below min_alpha (where the view has alpha) are left out. May return none.
std::vector<WindowPoint> make_window_points(const Camera& camera, std::span<const GradientImage> gradients,
                                            const ViewImages& view, const SE3& T_world_host, int wanted,
                                            PixelSelector& selector, const WindowPointOptions& options,
                                            const MapPlaneOptions& plane_options);

}  // namespace odosplat
