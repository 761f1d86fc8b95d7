// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core/types.hpp>
#include <string>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// What a map looks like from one pose. Images are either empty (not asked for, or not to be had from this kind of
/// map) or as large as the camera asked with.
struct ViewImages {
  DepthImage depth;  // [m], 0 where the map says nothing
  cv::Mat1f sigma;   // [m] standard deviation of depth, 0 where depth is 0
  cv::Mat1f alpha;   // 0..1, how much of the pixel the map covers
  ColorImage color;  // 0..1, R G B
};

/// Which images a caller wants; depth is always made, with sigma where the view knows it.
struct ViewRequest {
  bool color = false;
  bool alpha = false;
};

/// Images in which the map says nothing, as large as the camera's: depth and sigma, alpha if it is asked for, black
/// colours if they are asked for and `colors` says that the map has them.
ViewImages blank_images(const Camera& camera, const ViewRequest& request, bool colors);

/// A prior map as its users see it: something that can be looked at from a pose. The odometry knows this interface and
/// none of its implementations (Gaussians, interpolated cloud, surfels, a depth sensor).
class MapView {
 public:
  virtual ~MapView() = default;

  /// Renders the map seen from T_world_camera. A map with nothing in view gives images of zeros, not an error.
  /// The same call gives the same bits. Blocks. Not thread safe. Throws on a broken device only.
  virtual ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) = 0;

  /// The same at some pixels only (x: column, y: row), for consumers that use a few thousand of them: images of one
  /// row, pixels.size() wide, in the order given; pixels may repeat. The values are those of render. This one renders
  /// everything and picks; views that can do with less work override it. Throws InputError for a pixel outside the
  /// camera's image.
  virtual ViewImages render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                                   const std::vector<cv::Point>& pixels);

  /// A word for logs and reports: "gaussian", "interpolation", ...
  virtual std::string name() const = 0;
};

}  // namespace odosplat
