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

/// Images of a map seen from one pose. Each is either empty (not requested, or not provided by this kind of map) or of
/// the requested camera's size.
struct ViewImages {
  DepthImage depth;  // [m], 0 where the map has no depth
  cv::Mat1f sigma;   // [m] standard deviation of depth, 0 where depth is 0
  cv::Mat1f alpha;   // 0..1, share of the pixel that the map covers
  ColorImage color;  // 0..1, R G B
};

/// Which images a caller wants; depth is always rendered, with sigma where the view knows it.
struct ViewRequest {
  bool color = false;
  bool alpha = false;
};

/// Images of the camera's size for a view without any map data: zero depth and sigma; zero alpha if requested; black
/// colours if requested and if the map has colours (`colors`).
ViewImages blank_images(const Camera& camera, const ViewRequest& request, bool colors);

/// Interface of a prior map that can be rendered from any pose. The odometry depends on this interface and on none of
/// its implementations (Gaussians, interpolated cloud, surfels, a depth sensor).
class MapView {
 public:
  virtual ~MapView() = default;

  /// Renders the map seen from T_world_camera. If nothing is in view, the images are zero; this is not an error.
  /// Equal calls give bit-identical results. Blocks until done. Not thread safe. Throws only if the device fails.
  virtual ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) = 0;

  /// Renders only the given pixels (x: column, y: row), for callers that need a few thousand of them. Returns images of
  /// one row, pixels.size() wide, in the order given; pixels may repeat. The values equal those of render(). This
  /// default renders the whole image and picks the pixels; views that can render them with less work override it.
  /// Throws InputError for a pixel outside the camera's image.
  virtual ViewImages render_pixels(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request,
                                   const std::vector<cv::Point>& pixels);

  /// The name of this kind of map in logs and reports: "gaussian", "interpolation", ...
  virtual std::string name() const = 0;
};

}  // namespace odosplat
