// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/similarity.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

Similarity align_points(const std::vector<Eigen::Vector3d>& source, const std::vector<Eigen::Vector3d>& target,
                        bool with_scale) {
  if (source.size() != target.size()) throw InputError("alignment", "the lists differ in length");
  if (source.size() < 3) {
    throw InputError("alignment", "needs at least 3 pairs, there are " + std::to_string(source.size()));
  }
  const Eigen::Vector3d source_mean = mean_of(source);
  const Eigen::Vector3d target_mean = mean_of(target);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  double source_variance = 0.0;
  for (std::size_t i = 0; i < source.size(); ++i) {
    const Eigen::Vector3d s = source[i] - source_mean;
    covariance += (target[i] - target_mean) * s.transpose();
    source_variance += s.squaredNorm();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& singular = svd.singularValues();
  if (!(singular[1] > 1e-10 * singular[0]) || !(singular[0] > 0.0)) {
    throw InputError("alignment", "the positions coincide or lie on a line, so that the rotation is not determined");
  }
  Eigen::Vector3d sign = Eigen::Vector3d::Ones();
  if (svd.matrixU().determinant() * svd.matrixV().determinant() < 0.0) sign.z() = -1.0;
  const Eigen::Matrix3d R = svd.matrixU() * sign.asDiagonal() * svd.matrixV().transpose();
  Similarity similarity;
  if (with_scale) similarity.scale = singular.dot(sign) / source_variance;
  similarity.T_target_source = SE3(R, target_mean - similarity.scale * (R * source_mean));
  return similarity;
}

}  // namespace odosplat
