// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// What `view association` shows (the paper's Figure 1): depth that a view gets by interpolation between the points of
/// a discrete map and depth rendered from Gaussians; below them the points themselves as the view sees them.
struct AssociationFigure {
  cv::Size size{1600, 0};  // [px]; height 0: as the panels need
  Camera camera;
  SE3 T_world_camera;
  PointCloud cloud;         // m, world; may be empty
  DepthImage interpolated;  // [m], 0 or not finite = none; as large as the camera's image
  DepthImage rendered;      // likewise
  ColorImage image;         // may be empty: no panel then
  double depth_min = 0.0;   // [m] ends of the depth scale; both 0: from the two depth images
  double depth_max = 0.0;   // [m]
  std::string title;        // one line
};

/// Draws the figure: R, G, B, of the size asked for, on white. One depth scale for points and images; images are
/// hatched in grey where there is no depth. A point is drawn where it falls, on white, unless the rendered surface
/// stands more than 3 cm and 2 % of its depth before it: seen through walls, points would tell nothing. Same input,
/// same bytes. Needs no OpenGL. Any thread. Throws InputError for a bad size or camera, and for images of another size
/// than the camera's.
cv::Mat3b draw_association(const AssociationFigure& figure);

}  // namespace odosplat
