// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/neighbor_search.hpp"

#include <cstddef>
#include <nanoflann.hpp>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {

struct NeighborSearch::Tree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Tree>, Tree, 3, int>;

  explicit Tree(const std::vector<Eigen::Vector3f>& p) : points(p) {}

  // The interface that nanoflann asks of a data set.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  const std::vector<Eigen::Vector3f>& points;
  std::unique_ptr<Index> index;
};

NeighborSearch::NeighborSearch(const std::vector<Eigen::Vector3f>& points) : tree_(std::make_unique<Tree>(points)) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InputError("cloud", "point " + std::to_string(i), "is not finite");
  }
  if (!points.empty())
    tree_->index = std::make_unique<Tree::Index>(3, *tree_, nanoflann::KDTreeSingleIndexAdaptorParams(10));
}

NeighborSearch::~NeighborSearch() = default;

int NeighborSearch::nearest(const Eigen::Vector3f& query, int k, int* indices, float* squared_distances) const {
  if (!tree_->index || k <= 0) return 0;
  return static_cast<int>(
      tree_->index->knnSearch(query.data(), static_cast<std::size_t>(k), indices, squared_distances));
}

}  // namespace odosplat
