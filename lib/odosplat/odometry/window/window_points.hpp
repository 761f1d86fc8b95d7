// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <span>
#include <string>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/keyframe/keyframe.hpp"
#include "odosplat/odometry/points/pixel_selector.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

/// What a window's adjustment makes of the map's depth.
enum class DepthUse {
  fixed,             // inverse depth as rendered, moving with its keyframe
  pose_aware,        // the map's plane stays in the world: inverse depth follows from the keyframe's pose
  prior,             // estimated, with the rendered inverse depth as prior, moving with its keyframe
  pose_aware_prior,  // estimated, with the plane's inverse depth as prior
  free,              // estimated without prior; the map gives the start
  interval,          // searched for along epipolar lines around the rendered depth, then free (the paper's way)
};
/// The value of an option's word, spelled as above; InputError for others.
DepthUse depth_use(const std::string& word);
std::string to_string(DepthUse use);

struct WindowPointOptions {
  /// docs/rules.md compares the ways.
  DepthUse depth_use = DepthUse::pose_aware_prior;
  int points = 350;                                   // wanted of a keyframe, for the window's adjustment
  int anchor_points = 700;                            // wanted of a rendered view
  double gradient_weight = gradient_weight_constant;  // [grey/px] c of the weight c^2 / (c^2 + |gradient|^2)
  double min_alpha = 0.9;                             // a rendered pixel must be covered this much to serve as anchor

  void check() const;
};

/// Points of an image seen from T_world_host with the depth of `view`, which must have been rendered from that pose.
/// gradients: of the host's image, full size first. Pixels whose pattern leaves the image, without trusted depth, or
/// with alpha below min_alpha (where the view has alpha) are left out. `use` takes the place of the options'; interval
/// gives points as free does. May return none.
std::vector<WindowPoint> make_window_points(const Camera& camera, std::span<const GradientImage> gradients,
                                            const ViewImages& view, const SE3& T_world_host, int wanted,
                                            PixelSelector& selector, const WindowPointOptions& options,
                                            const MapPlaneOptions& plane_options, DepthUse use);

}  // namespace odosplat
