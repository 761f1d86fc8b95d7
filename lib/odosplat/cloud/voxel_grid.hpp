// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace odosplat {

/// Sums of the points in each voxel, used by all filters that thin a cloud. Cells are numbered in the order in which
/// they got their first point, so that results depend on the input alone. Not thread safe.
class VoxelGrid {
 public:
  struct Cell {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();   // [m] sum
    Eigen::Vector3f color = Eigen::Vector3f::Zero();   // sum
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // sum; CloudBuilder keeps viewing rays here
    int count = 0;
  };

  /// voxel: edge of a cell [m], > 0 and finite, else InputError.
  explicit VoxelGrid(double voxel);

  /// The cell of a point, created if it is new; nullptr for a point that is not finite. If voxels are smaller than the
  /// resolution of double precision at the point, every distinct position is a cell of its own. Throws InputError if
  /// the point is farther from the origin than 1.8e308 voxels. The pointer is valid until the next call.
  Cell* at(const Eigen::Vector3d& point);

  const std::vector<Cell>& cells() const { return cells_; }

 private:
  // Whole numbers, stored as doubles so that any voxel index fits.
  struct Key {
    double x, y, z;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& k) const;
  };

  double voxel_;
  std::unordered_map<Key, std::uint32_t, Hash> index_;
  std::vector<Cell> cells_;
};

}  // namespace odosplat
