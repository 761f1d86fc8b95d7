// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat {

/// The grey values of a rendered view, and their pyramid.
struct RenderedGray {
  GrayImage gray;
  FramePyramid pyramid;
};

/// smoothing: as that of the images' pyramids [px]. Null for a view without colours.
std::shared_ptr<const RenderedGray> gray_of(const Camera& camera, const ViewImages& images, double smoothing);

/// The images of the map rendered from one pose, with that pose.
struct RenderedView {
  SE3 T_world_camera;
  ViewImages images;
  std::shared_ptr<const RenderedGray> gray = {};  // gray_of(images); null: not computed yet, or without colours
};

/// Root mean square motion [px] of what the view shows when the camera goes from there to T_world_camera, over a grid
/// of pixels with depth. Infinite where it shows nothing or where most of it leaves the image.
double view_flow(const Camera& camera, const RenderedView& view, const SE3& T_world_camera);

}  // namespace odosplat
