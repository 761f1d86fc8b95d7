// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/cloud_thinner.hpp"

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat {

CloudThinner::CloudThinner(double voxel, const Eigen::Vector3d& origin) : grid_(voxel), origin_(origin) {
  require(origin.allFinite(), "origin", "finite [m]");
}

void CloudThinner::add(const CloudBatch& batch) {
  for (std::size_t i = 0; i < batch.points.size(); ++i) {
    const Eigen::Vector3d point = batch.points[i] - origin_;
    VoxelGrid::Cell* cell = grid_.at(point);
    if (!cell) continue;
    ++points_;
    ++cell->count;
    cell->point += point;
    if (!batch.colors.empty()) {
      cell->color += batch.colors[i];
      ++with_color_;
    }
    if (!batch.normals.empty() && !batch.normals[i].isZero(0.0F)) {
      cell->normal += batch.normals[i];
      ++with_normal_;
    }
  }
}

PointCloud CloudThinner::finish(const std::string& name) const {
  const bool colored = all_have(name, with_color_, "colour");
  const bool oriented = all_have(name, with_normal_, "normal");
  PointCloud cloud;
  cloud.points.reserve(voxels());
  for (const VoxelGrid::Cell& cell : grid_.cells()) {
    cloud.points.push_back(round_point(name, cell.point / cell.count));
    if (colored) cloud.colors.emplace_back(cell.color / static_cast<float>(cell.count));
    if (oriented) {
      // Opposite normals cancel if a voxel contains both sides of a thin sheet. Any direction may be used then.
      const float length = cell.normal.norm();
      cloud.normals.emplace_back(length > 1e-6F ? Eigen::Vector3f(cell.normal / length) : Eigen::Vector3f::UnitZ());
    }
  }
  return cloud;
}

bool CloudThinner::all_have(const std::string& name, std::size_t with, const char* what) const {
  if (with > 0 && with < points_) {
    log_warning(name + ": " + std::to_string(points_ - with) + " of " + std::to_string(points_) + " points have no " +
                what + "; those of all points are left out");
  }
  return points_ > 0 && with == points_;
}

}  // namespace odosplat
