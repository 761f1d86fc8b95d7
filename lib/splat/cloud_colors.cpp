// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/cloud_colors.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/map/cloud_filters.hpp"
#include "odosplat/map/projected_points.hpp"

namespace odosplat {

namespace {

constexpr int spacing_neighbors = 6;
constexpr int normal_neighbors = 12;
constexpr double min_depth = 0.05;       // [m]
constexpr double disc_spacings = 1.0;    // radius of the discs that hide
constexpr float hidden_spacings = 1.5F;  // how far behind a disc a point is hidden, in spacings ...
constexpr float hidden_share = 0.01F;    // ... plus this share of its depth
const Eigen::Vector3f grey = Eigen::Vector3f::Constant(0.5F);

}  // namespace

void color_from_views(PointCloud& cloud, TrainingViews& views, int most_views) {
  PointCloud surface = cloud;
  if (!surface.has_normals()) estimate_normals(surface, normal_neighbors);
  const std::vector<float> spacings = mean_neighbor_distances(surface, spacing_neighbors);
  std::vector<Eigen::Vector3f> sums(cloud.size(), Eigen::Vector3f::Zero());
  std::vector<int> counts(cloud.size(), 0);
  const int used = std::min(most_views, views.count());
  for (int k = 0; k < used; ++k) {
    const int view = static_cast<int>(static_cast<long>(k) * views.count() / used);
    const Camera camera = views.camera(view);
    const ColorImage image = views.color(view);
    const std::vector<ProjectedPoint> points =
        project_points(surface, spacings, camera, views.T_world_camera(view), min_depth, disc_spacings);
    const cv::Mat1f nearest = splat_discs(points, camera, disc_spacings);
    for (const ProjectedPoint& p : points) {
      const int x = static_cast<int>(std::lround(p.u));
      const int y = static_cast<int>(std::lround(p.v));
      if (x < 0 || y < 0 || x >= image.cols || y >= image.rows) continue;
      const float z = p.p_camera.z();
      if (z > nearest(y + projection_margin, x + projection_margin) + hidden_spacings * p.spacing + hidden_share * z)
        continue;
      const cv::Vec3f& pixel = image(y, x);
      sums[static_cast<std::size_t>(p.index)] += Eigen::Vector3f(pixel[0], pixel[1], pixel[2]);
      ++counts[static_cast<std::size_t>(p.index)];
    }
  }
  cloud.colors.resize(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i)
    cloud.colors[i] = counts[i] > 0 ? Eigen::Vector3f(sums[i] / static_cast<float>(counts[i])) : grey;
}

}  // namespace odosplat
