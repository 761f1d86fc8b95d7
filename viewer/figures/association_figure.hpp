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

/// Content of `view association` (the paper's Figure 1): depth of a view interpolated between the points of a discrete
/// map, and depth rendered from Gaussians; below them the points themselves in the same view.
struct AssociationFigure {
  cv::Size size{1600, 0};  // [px]; height 0: as needed by the panels
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

/// Draws the figure: R, G, B, of the given size, on white. Points and depth images have the same depth scale; pixels
/// without depth are hatched in grey. Points are drawn on white; a point more than 3 cm plus 2 % of the depth behind
/// the rendered surface is occluded and left out. Same input, same bytes. Needs no OpenGL. Any thread. Throws
/// InputError for an invalid size or camera, and for images of another size than the camera's.
cv::Mat3b draw_association(const AssociationFigure& figure);

}  // namespace odosplat
