// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/rendered_view.hpp"

#include <cmath>
#include <limits>

namespace odosplat {

std::shared_ptr<const RenderedGray> gray_of(const Camera& camera, const ViewImages& images, double smoothing) {
  if (images.color.empty()) return nullptr;
  const GrayImage gray = to_gray(images.color);
  return std::make_shared<RenderedGray>(RenderedGray{gray, build_frame_pyramid(camera, gray, smoothing)});
}

double view_flow(const Camera& camera, const RenderedView& view, const SE3& T_world_camera) {
  constexpr int step = 16;  // [px]
  const SE3 T_camera_view = T_world_camera.inverse() * view.T_world_camera;
  double squares = 0.0;
  int with_depth = 0;
  int in_view = 0;
  for (int y = step / 2; y < view.images.depth.rows; y += step) {
    for (int x = step / 2; x < view.images.depth.cols; x += step) {
      const double z = view.images.depth(y, x);
      if (!(z > 0.0)) continue;
      ++with_depth;
      const Eigen::Vector3d p = T_camera_view * (z * camera.ray(x, y));
      if (!(p.z() > 0.0)) continue;
      const Eigen::Vector2d uv = camera.project(p);
      if (!(uv.x() >= 0.0 && uv.y() >= 0.0 && uv.x() <= camera.width - 1 && uv.y() <= camera.height - 1)) continue;
      ++in_view;
      squares += (uv - Eigen::Vector2d(x, y)).squaredNorm();
    }
  }
  if (in_view == 0 || 2 * in_view < with_depth) return std::numeric_limits<double>::infinity();
  return std::sqrt(squares / in_view);
}

}  // namespace odosplat
