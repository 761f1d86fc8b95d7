// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/raster/viewpoint.hpp"

#include "kernels/constants.h"

namespace odosplat {

Viewpoint make_viewpoint(const Camera& camera, const SE3& T_world_camera) {
  Viewpoint view;
  const SE3 T_camera_world = T_world_camera.inverse();
  const Eigen::Matrix3d R = T_camera_world.rotation_matrix();
  for (std::size_t r = 0; r < 3; ++r) {
    const auto row = static_cast<Eigen::Index>(r);
    for (std::size_t c = 0; c < 3; ++c) {
      view.pose[3 * r + c] = static_cast<float>(R(row, static_cast<Eigen::Index>(c)));
    }
    view.pose[9 + r] = static_cast<float>(T_camera_world.translation()[row]);
    view.pose[12 + r] = static_cast<float>(T_world_camera.translation()[row]);
  }
  const double margin_x = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.width / camera.fx;
  const double margin_y = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.height / camera.fy;
  view.lens = {static_cast<float>(camera.fx),
               static_cast<float>(camera.fy),
               static_cast<float>(camera.cx),
               static_cast<float>(camera.cy),
               static_cast<float>((-0.5 - camera.cx) / camera.fx - margin_x),
               static_cast<float>((camera.width - 0.5 - camera.cx) / camera.fx + margin_x),
               static_cast<float>((-0.5 - camera.cy) / camera.fy - margin_y),
               static_cast<float>((camera.height - 0.5 - camera.cy) / camera.fy + margin_y)};
  const int columns = (camera.width + TILE_WIDTH - 1) / TILE_WIDTH;
  const int rows = (camera.height + TILE_HEIGHT - 1) / TILE_HEIGHT;
  view.grid = {camera.width, camera.height, columns, rows};
  view.tiles = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  view.pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  return view;
}

}  // namespace odosplat
