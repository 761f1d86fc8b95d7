// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/neighbor_search.hpp"

#include <cstddef>
#include <nanoflann.hpp>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {

struct NeighborSearch::Tree {
  using Index = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Tree>, Tree, 3, int>;

  explicit Tree(const std::vector<Eigen::Vector3f>& p) : points(p) {}

  // The interface of a data set that nanoflann requires.
  std::size_t kdtree_get_point_count() const { return points.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<Eigen::Index>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  const std::vector<Eigen::Vector3f>& points;
  std::unique_ptr<Index> index;
};

namespace {

/// The k nearest points so far. Once all of them have distance 0 the search ends. Otherwise a search among coinciding
/// points would visit every one of them, and searches for all N points would take N^2 steps.
class NearestSet : public nanoflann::KNNResultSet<float, int> {
 public:
  using nanoflann::KNNResultSet<float, int>::KNNResultSet;
  float worstDist() const {  // NOLINT(readability-identifier-naming): nanoflann's name
    const float worst = nanoflann::KNNResultSet<float, int>::worstDist();
    return worst > 0.0F ? worst : -1.0F;
  }
};

}  // namespace

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
  NearestSet set(static_cast<std::size_t>(k));
  set.init(indices, squared_distances);
  tree_->index->findNeighbors(set, query.data(), {});
  return static_cast<int>(set.size());
}

}  // namespace odosplat
