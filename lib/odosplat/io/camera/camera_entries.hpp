// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// The camera that took the depth images, where these are not registered to the colour images.
struct DepthCamera {
  Camera camera;      // without distortion; of the depth images' size, which may differ from the colour images'
  SE3 T_color_depth;  // p_color = T_color_depth * p_depth [m]
  // [s] A depth image was taken at its stamp (or its colour image's) plus this, as the clock of the poses counts.
  double time_offset = 0.0;
};

/// The contents of a camera.yaml. Keys: width height fx fy cx cy (all required), depth_scale, distortion
/// [k1 k2 p1 p2 k3], fps, time_offset, line_time (camera.readout by the rows), gamma, vignette, depth_camera.
struct CameraFile {
  Camera camera;    // fy > 0 always; pixel centres at integers
  int fy_sign = 1;  // -1: the file has a negative fy, so poses, and points of the same data set, are reflected
  double depth_scale = 1000.0;              // units of a 16-bit depth image per metre
  bool has_depth_scale = false;             // false: not given by the file, the layout's default applies
  std::vector<double> distortion;           // k1 k2 p1 p2 k3 (OpenCV's order; 4 values: k3 = 0); empty: none
  double fps = 0.0;                         // [1/s], 0: not given
  double time_offset = 0.0;                 // [s] an image was taken this much after its stamp, by the poses' clock
  double gamma = 0.0;                       // of the response, stored = radiance^(1 / gamma); 0: not given
  std::optional<DepthCamera> depth_camera;  // none: depth images are registered to the colour images
  std::string vignette;                     // image file, relative to the camera file (read_vignette); empty: none

  /// [s] How much after their stamps the depth images were taken: the depth camera's own offset if there is a depth
  /// camera; else time_offset, because the same camera took both.
  double depth_time_offset() const { return depth_camera ? depth_camera->time_offset : time_offset; }
};

}  // namespace odosplat
