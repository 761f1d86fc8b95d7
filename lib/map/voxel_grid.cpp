// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/voxel_grid.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {

VoxelGrid::VoxelGrid(double voxel) : voxel_(voxel) {
  require(std::isfinite(voxel) && voxel > 0.0, "voxel", "positive [m]");
}

std::size_t VoxelGrid::Hash::operator()(const Key& k) const {
  // Odd multipliers spread neighbours over the whole word; the shift brings the upper bits down to the bucket number.
  std::uint64_t h = static_cast<std::uint32_t>(k.x) * 0x9e3779b97f4a7c15ULL;
  h ^= static_cast<std::uint32_t>(k.y) * 0xc2b2ae3d27d4eb4fULL;
  h ^= static_cast<std::uint32_t>(k.z) * 0x165667b19e3779f9ULL;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

VoxelGrid::Cell* VoxelGrid::at(const Eigen::Vector3d& point) {
  const Eigen::Vector3d p = point / voxel_;
  if (!(p.cwiseAbs().maxCoeff() < 1e9) || !p.allFinite()) return nullptr;
  const Key key{static_cast<std::int32_t>(std::floor(p.x())), static_cast<std::int32_t>(std::floor(p.y())),
                static_cast<std::int32_t>(std::floor(p.z()))};
  const auto [it, is_new] = index_.try_emplace(key, static_cast<std::uint32_t>(cells_.size()));
  if (is_new) cells_.emplace_back();
  return &cells_[it->second];
}

}  // namespace odosplat
