// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/local_planes.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

LocalPlane fit(const PointCloud& cloud, const std::vector<int>& indices, int n) {
  LocalPlane plane;
  if (n < 3) return plane;
  // Relative to the first point, to keep precision for clouds far from the origin.
  const Eigen::Vector3d origin = cloud.points[static_cast<std::size_t>(indices[0])].cast<double>();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d d =
        cloud.points[static_cast<std::size_t>(indices[static_cast<std::size_t>(i)])].cast<double>() - origin;
    sum += d;
    squares += d * d.transpose();
  }
  const Eigen::Matrix3d scatter = squares - sum * sum.transpose() / n;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Eigen::Vector3d normal = solver.eigenvectors().col(0).normalized();
  Eigen::Index largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  if (normal[largest] < 0.0) normal = -normal;
  plane.normal = normal.cast<float>();
  if (n > 3) plane.residual = static_cast<float>(std::sqrt(std::max(0.0, solver.eigenvalues()[0]) / (n - 3)));
  return plane;
}

}  // namespace

std::vector<LocalPlane> fit_local_planes(const PointCloud& cloud, int k) {
  require(k >= 3, "neighbors", "at least 3");
  const NeighborSearch search(cloud.points);
  std::vector<LocalPlane> planes(cloud.size());
  parallel_for(static_cast<int>(cloud.size()), 1024, [&](int begin, int end) {
    std::vector<int> indices(static_cast<std::size_t>(k) + 1);
    std::vector<float> distances(indices.size());
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const int n = search.nearest(cloud.points[at], k + 1, indices.data(), distances.data());
      planes[at] = fit(cloud, indices, n);
    }
  });
  return planes;
}

}  // namespace odosplat
