// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>

#include "odosplat/cloud/voxel_grid.hpp"
#include "odosplat/core/cloud_batch.hpp"
#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// Thins a cloud to one point per voxel while it is read, with memory proportional to the number of voxels, not of
/// points. Each resulting point has the mean position and colour of the points in its voxel and their mean normal,
/// scaled to unit length. Order: that of each voxel's first point. Voxels are aligned to the origin.
/// Deterministic: the same points in the same order give the same bits, however they are divided into batches. Not
/// thread safe.
class CloudThinner {
 public:
  /// voxel: edge [m], > 0, else InputError. origin [m] is subtracted from every point first, in double precision, which
  /// brings a cloud in survey coordinates near the origin.
  explicit CloudThinner(double voxel, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

  /// Points that are not finite are dropped. Throws InputError for a voxel that is too small for a point
  /// (VoxelGrid::at).
  void add(const CloudBatch& batch);

  /// The cloud so far. If some points have no colours, or no normals, these are left out for the whole cloud, with a
  /// warning in the log. Throws InputError naming `name` as round_point does.
  PointCloud finish(const std::string& name) const;

  std::size_t points() const { return points_; }  // number added so far
  std::size_t voxels() const { return grid_.cells().size(); }

 private:
  bool all_have(const std::string& name, std::size_t with, const char* what) const;

  VoxelGrid grid_;
  Eigen::Vector3d origin_;
  std::size_t points_ = 0;
  std::size_t with_color_ = 0;
  std::size_t with_normal_ = 0;
};

}  // namespace odosplat
