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

/// Thins a cloud to one point a voxel while it is read, in memory that grows with the voxels, not with the points: each
/// point kept is the mean of those in its voxel, its colour their mean colour, its normal their mean normal brought
/// back to unit length. Order: that of each voxel's first point. Voxels are aligned to the origin.
/// Deterministic: the same batches in the same order give the same bits, however they are cut. Not thread safe.
class CloudThinner {
 public:
  /// voxel: edge [m], > 0, else InputError. origin [m] is taken off every point before anything else, in double
  /// precision: the way to bring a cloud in survey coordinates near.
  explicit CloudThinner(double voxel, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero());

  /// Points that are not finite are dropped. InputError for a voxel that is too small for a point (VoxelGrid::at).
  void add(const CloudBatch& batch);

  /// The cloud so far. Colours and normals are all or nothing: if some points came without, they are left out, with a
  /// warning on the log. Throws InputError naming `name` as round_point says.
  PointCloud finish(const std::string& name) const;

  std::size_t points() const { return points_; }  // taken so far
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
