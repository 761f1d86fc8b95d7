// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/voxel_grid.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {

VoxelGrid::VoxelGrid(double voxel) : voxel_(voxel) {
  require(std::isfinite(voxel) && voxel > 0.0, "voxel", "positive [m]");
}

std::size_t VoxelGrid::Hash::operator()(const Key& k) const {
  // Odd multipliers spread neighbouring cells over the whole word; the shifts move upper bits down, first those of the
  // keys, whose lower bits are zero.
  const auto bits = [](double value) {
    const auto word = std::bit_cast<std::uint64_t>(value);
    return word ^ (word >> 32);
  };
  std::uint64_t h = bits(k.x) * 0x9e3779b97f4a7c15ULL;
  h ^= bits(k.y) * 0xc2b2ae3d27d4eb4fULL;
  h ^= bits(k.z) * 0x165667b19e3779f9ULL;
  return static_cast<std::size_t>(h ^ (h >> 32));
}

VoxelGrid::Cell* VoxelGrid::at(const Eigen::Vector3d& point) {
  if (!point.allFinite()) return nullptr;
  const Eigen::Vector3d p = point / voxel_;
  if (!p.allFinite()) {
    throw InputError("voxel", formatted("is too small: %.3g m for a point at %.3g %.3g %.3g", voxel_, point.x(),
                                        point.y(), point.z()));
  }
  // Adding 0.0 turns -0.0 into +0.0: the two are equal but have different bits, and so different hashes.
  const Key key{std::floor(p.x()) + 0.0, std::floor(p.y()) + 0.0, std::floor(p.z()) + 0.0};
  const auto [it, is_new] = index_.try_emplace(key, static_cast<std::uint32_t>(cells_.size()));
  if (is_new) {
    require(cells_.size() < std::numeric_limits<std::uint32_t>::max(), "voxel",
            "larger: over 4294967294 voxels hold points");
    cells_.emplace_back();
  }
  return &cells_[it->second];
}

}  // namespace odosplat
