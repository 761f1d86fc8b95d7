// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace odosplat {

/// Nearest neighbours among 3D points, by a kd-tree.
/// The points are not copied: they must outlive the search and must not change. Points may coincide. Throws InputError
/// naming the first point that is not finite. nearest() may be called from several threads at once; equal calls give
/// equal results.
class NeighborSearch {
 public:
  explicit NeighborSearch(const std::vector<Eigen::Vector3f>& points);
  ~NeighborSearch();
  NeighborSearch(const NeighborSearch&) = delete;
  NeighborSearch& operator=(const NeighborSearch&) = delete;

  /// Writes the indices of the k points nearest to query and their squared distances [m^2], nearest first; both arrays
  /// must have room for k. Returns their number, min(k, number of points).
  int nearest(const Eigen::Vector3f& query, int k, int* indices, float* squared_distances) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace odosplat
