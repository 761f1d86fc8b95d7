// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Which points of a cloud an image shows: those in it that no nearer points hide. A point hides what lies behind a
/// disc of the points' spacing, perpendicular to its normal; normals are estimated if the cloud has none. Frames: cloud
/// and poses in one world frame [m]. Throws InputError for points that are not finite. Uses all threads when it is
/// made; deterministic. in() may be called from several threads at once.
class SeenPoints {
 public:
  struct Point {
    std::size_t index;  // in the cloud
    float u, v;         // [px], within half a pixel of the image's pixels
  };

  explicit SeenPoints(const PointCloud& cloud);
  std::vector<Point> in(const Camera& camera, const SE3& T_world_camera) const;
  std::size_t size() const { return surface_.size(); }

 private:
  PointCloud surface_;           // without colours
  std::vector<float> spacings_;  // [m]
};

/// At most `most` points of a cloud, evenly spread over its order.
PointCloud thinned_evenly(const PointCloud& cloud, std::size_t most);

}  // namespace odosplat
