// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/cloud_colors.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/splat/quality/seen_points.hpp"

namespace odosplat {

namespace {
const Eigen::Vector3f grey = Eigen::Vector3f::Constant(0.5F);
}  // namespace

void color_from_views(PointCloud& cloud, TrainingViews& views, int most_views) {
  const SeenPoints surface(cloud);
  std::vector<Eigen::Vector3f> sums(cloud.size(), Eigen::Vector3f::Zero());
  std::vector<int> counts(cloud.size(), 0);
  const int used = std::min(most_views, views.count());
  for (int k = 0; k < used; ++k) {
    const int view = static_cast<int>(static_cast<long>(k) * views.count() / used);
    const ColorImage image = views.color(view);
    for (const SeenPoints::Point& p : surface.in(views.camera(view), views.T_world_camera(view))) {
      const cv::Vec3f& pixel = image(static_cast<int>(std::lround(p.v)), static_cast<int>(std::lround(p.u)));
      sums[p.index] += Eigen::Vector3f(pixel[0], pixel[1], pixel[2]);
      ++counts[p.index];
    }
  }
  cloud.colors.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colors[i] = counts[i] > 0 ? Eigen::Vector3f(sums[i] / static_cast<float>(counts[i])) : grey;
}

}  // namespace odosplat
