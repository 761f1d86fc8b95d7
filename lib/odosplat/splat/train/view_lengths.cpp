// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/view_lengths.hpp"
#include "odosplat/core/upper_median.hpp"

#include <algorithm>
#include <vector>

namespace odosplat {

double camera_extent(const TrainingViews& views) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (int i = 0; i < views.count(); ++i) mean += views.T_world_camera(i).translation() / views.count();
  double extent = 0.0;
  for (int i = 0; i < views.count(); ++i)
    extent = std::max(extent, (views.T_world_camera(i).translation() - mean).norm());
  return extent > 0.0 ? extent : 1.0;
}

double pixel_width(const Gaussians& gaussians, const TrainingViews& views) {
  constexpr std::size_t most_gaussians = 2000;
  constexpr int most_views = 40;
  const std::size_t stride = std::max<std::size_t>(1, gaussians.size() / most_gaussians);
  const int used = std::min(most_views, views.count());
  std::vector<double> widths;
  for (int k = 0; k < used; ++k) {
    const int view = static_cast<int>(static_cast<long>(k) * views.count() / used);
    const Camera camera = views.camera(view);
    const SE3 T_camera_world = views.T_world_camera(view).inverse();
    for (std::size_t i = 0; i < gaussians.size(); i += stride) {
      const Eigen::Vector3f p_world(&gaussians.positions[3 * i]);
      const Eigen::Vector3d p_camera = T_camera_world * p_world.cast<double>();
      if (!(p_camera.z() > 0.0)) continue;
      const Eigen::Vector2d pixel = camera.project(p_camera);
      if (pixel.x() < -0.5 || pixel.y() < -0.5 || pixel.x() > camera.width - 0.5 || pixel.y() > camera.height - 0.5)
        continue;
      widths.push_back(p_camera.z() / std::max(camera.fx, camera.fy));
    }
  }
  return upper_median(std::move(widths));
}

}  // namespace odosplat
