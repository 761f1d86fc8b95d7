// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/seen_points.hpp"

#include <cmath>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/cloud/projected_points.hpp"

namespace odosplat {

namespace {

constexpr int spacing_neighbors = 6;
constexpr int normal_neighbors = 12;
constexpr double min_depth = 0.05;       // [m]
constexpr double disc_spacings = 1.0;    // radius of the discs that hide, in spacings
constexpr float hidden_spacings = 1.5F;  // how far behind a disc a point is hidden, in spacings ...
constexpr float hidden_share = 0.01F;    // ... plus this share of its depth

}  // namespace

SeenPoints::SeenPoints(const PointCloud& cloud) {
  surface_.points = cloud.points;
  surface_.normals = cloud.normals;
  if (!surface_.has_normals()) estimate_normals(surface_, normal_neighbors);
  spacings_ = mean_neighbor_distances(surface_, spacing_neighbors);
}

std::vector<SeenPoints::Point> SeenPoints::in(const Camera& camera, const SE3& T_world_camera) const {
  const std::vector<ProjectedPoint> points =
      project_points(surface_, spacings_, camera, T_world_camera, min_depth, disc_spacings);
  const cv::Mat1f nearest = splat_discs(points, camera, disc_spacings);
  std::vector<Point> seen;
  for (const ProjectedPoint& p : points) {
    // Compared as floats: the centre of a disc right before the camera can lie beyond the range of int.
    if (!(std::abs(p.u) < 1e6F && std::abs(p.v) < 1e6F)) continue;
    const int x = static_cast<int>(std::lround(p.u));
    const int y = static_cast<int>(std::lround(p.v));
    if (x < 0 || y < 0 || x >= camera.width || y >= camera.height) continue;
    const float z = p.p_camera.z();
    if (z > nearest(y + projection_margin, x + projection_margin) + hidden_spacings * p.spacing + hidden_share * z)
      continue;
    seen.push_back({static_cast<std::size_t>(p.index), p.u, p.v});
  }
  return seen;
}

PointCloud thinned_evenly(const PointCloud& cloud, std::size_t most) {
  if (cloud.size() <= most) return cloud;
  PointCloud thin;
  for (std::size_t k = 0; k < most; ++k) {
    const std::size_t i = k * cloud.size() / most;
    thin.points.push_back(cloud.points[i]);
    if (cloud.has_colors()) thin.colors.push_back(cloud.colors[i]);
    if (cloud.has_normals()) thin.normals.push_back(cloud.normals[i]);
  }
  return thin;
}

}  // namespace odosplat
