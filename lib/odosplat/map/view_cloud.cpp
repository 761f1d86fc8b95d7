// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/view_cloud.hpp"

#include <cstddef>

#include "odosplat/cloud/cloud_filters.hpp"

namespace odosplat {

PointCloud finite_part(const PointCloud& cloud, CloudNormals normals) {
  const bool with_normals = cloud.has_normals() && normals == CloudNormals::used;
  PointCloud finite;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!cloud.points[i].allFinite()) continue;
    finite.points.push_back(cloud.points[i]);
    if (cloud.has_colors()) finite.colors.push_back(cloud.colors[i]);
    if (with_normals) finite.normals.push_back(cloud.normals[i]);
  }
  return finite;
}

std::vector<float> point_spacings(const PointCloud& cloud) { return mean_neighbor_distances(cloud, 6); }

}  // namespace odosplat
