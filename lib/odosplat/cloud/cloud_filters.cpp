// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/cloud_filters.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/cloud/local_planes.hpp"
#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/cloud/voxel_grid.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {

PointCloud voxel_downsample(const PointCloud& cloud, double voxel_m) {
  VoxelGrid grid(voxel_m);
  const bool with_colors = cloud.has_colors();
  const bool with_normals = cloud.has_normals();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    VoxelGrid::Cell* cell = grid.at(cloud.points[i].cast<double>());
    if (!cell) continue;
    cell->point += cloud.points[i].cast<double>();
    if (with_colors) cell->color += cloud.colors[i];
    if (with_normals) cell->normal += cloud.normals[i];
    ++cell->count;
  }
  PointCloud thin;
  thin.points.reserve(grid.cells().size());
  for (const VoxelGrid::Cell& cell : grid.cells()) {
    thin.points.emplace_back((cell.point / cell.count).cast<float>());
    if (with_colors) thin.colors.emplace_back(cell.color / static_cast<float>(cell.count));
    if (with_normals) {
      // Opposite normals cancel if a voxel contains both sides of a thin sheet. Any direction may be used then.
      const float length = cell.normal.norm();
      thin.normals.emplace_back(length > 1e-6F ? Eigen::Vector3f(cell.normal / length) : Eigen::Vector3f::UnitZ());
    }
  }
  return thin;
}

void estimate_normals(PointCloud& cloud, int k, const std::vector<Eigen::Vector3d>& viewpoints) {
  const std::vector<LocalPlane> planes = fit_local_planes(cloud, k);
  std::vector<Eigen::Vector3f> eyes;
  eyes.reserve(viewpoints.size());
  for (const Eigen::Vector3d& v : viewpoints) {
    if (!v.allFinite()) throw InputError("viewpoint", "is not finite");
    eyes.emplace_back(v.cast<float>());
  }
  const NeighborSearch nearest_eye(eyes);
  cloud.normals.resize(cloud.size());
  parallel_for(static_cast<int>(cloud.size()), 4096, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      Eigen::Vector3f normal = planes[at].normal;
      int eye = 0;
      float squared_distance = 0.0F;
      if (nearest_eye.nearest(cloud.points[at], 1, &eye, &squared_distance) == 1 &&
          normal.dot(eyes[static_cast<std::size_t>(eye)] - cloud.points[at]) < 0.0F) {
        normal = -normal;
      }
      cloud.normals[at] = normal;
    }
  });
}

std::vector<float> mean_neighbor_distances(const PointCloud& cloud, int k) {
  require(k >= 1, "neighbors", "at least 1");
  const NeighborSearch search(cloud.points);
  std::vector<float> means(cloud.size(), 0.0F);
  parallel_for(static_cast<int>(cloud.size()), 1024, [&](int begin, int end) {
    std::vector<int> indices(static_cast<std::size_t>(k) + 1);
    std::vector<float> squared_distances(indices.size());
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int n = search.nearest(cloud.points[at], k + 1, indices.data(), squared_distances.data());
      // The first neighbour, at distance 0, is the point itself or a copy of it, and is left out.
      double sum = 0.0;
      for (int j = 1; j < n; ++j) sum += std::sqrt(static_cast<double>(squared_distances[static_cast<std::size_t>(j)]));
      if (n > 1) means[at] = static_cast<float>(sum / (n - 1));
    }
  });
  return means;
}

PointCloud remove_outliers(const PointCloud& cloud, int k, double deviations) {
  require(std::isfinite(deviations) && deviations >= 0.0, "deviations", "at least 0");
  const std::vector<float> distances = mean_neighbor_distances(cloud, k);
  double sum = 0.0;
  for (const float d : distances) sum += d;
  const double mean = distances.empty() ? 0.0 : sum / static_cast<double>(distances.size());
  double squares = 0.0;
  for (const float d : distances) squares += (d - mean) * (d - mean);
  const double deviation = distances.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(distances.size()));
  PointCloud kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (distances[i] > mean + deviations * deviation) continue;
    kept.points.push_back(cloud.points[i]);
    if (cloud.has_colors()) kept.colors.push_back(cloud.colors[i]);
    if (cloud.has_normals()) kept.normals.push_back(cloud.normals[i]);
  }
  return kept;
}

}  // namespace odosplat
