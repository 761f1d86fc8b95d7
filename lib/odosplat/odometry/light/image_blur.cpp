// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/light/image_blur.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int blur_reweightings = 3;
constexpr std::size_t min_samples = 100;

using Vector11d = Eigen::Matrix<double, 11, 1>;
using Matrix11d = Eigen::Matrix<double, 11, 11>;

struct Row {
  Vector11d J;  // of the residual, by the alignment's 8 parameters and the kernel's xx, xy, yy
  double residual = 0.0;
  double weight = 0.0;
};

std::vector<Row> rows_of(const GradientImage& host, const std::vector<BrightnessSample>& samples, double gain) {
  std::vector<Row> rows;
  rows.reserve(samples.size());
  for (const BrightnessSample& sample : samples) {
    const int x = static_cast<int>(std::lround(sample.u));
    const int y = static_cast<int>(std::lround(sample.v));
    if (x < 2 || y < 2 || x >= host.cols - 2 || y >= host.rows - 2) continue;
    const double xx = 0.5 * (host(y, x + 1)[1] - host(y, x - 1)[1]);
    const double xy = 0.5 * (host(y + 1, x)[1] - host(y - 1, x)[1]);
    const double yy = 0.5 * (host(y + 1, x)[2] - host(y - 1, x)[2]);
    Row row;
    row.J << sample.by_alignment, -0.5 * gain * xx, -gain * xy, -0.5 * gain * yy;
    row.residual = sample.residual;
    row.weight = sample.weight;
    rows.push_back(row);
  }
  return rows;
}

struct BlurFit {
  Vector11d x = Vector11d::Zero();
  double cost = 0.0;  // robust
};

/// unknowns: 8 for the alignment alone, or 11.
BlurFit fit_blur(const std::vector<Row>& rows, Eigen::Index unknowns, double huber) {
  BlurFit result;
  for (int pass = 0; pass < blur_reweightings; ++pass) {
    Matrix11d H = Matrix11d::Zero();
    Vector11d g = Vector11d::Zero();
    for (const Row& row : rows) {
      const double r = std::abs(row.residual + row.J.dot(result.x));
      const double w = row.weight * huber / std::max(huber, r);
      H += w * row.J * row.J.transpose();
      g += (w * row.residual) * row.J;
    }
    const Eigen::VectorXd scale = H.diagonal().head(unknowns).cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * H.topLeftCorner(unknowns, unknowns) * scale.asDiagonal();
    result.x.head(unknowns) = -scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(g.head(unknowns))));
  }
  for (const Row& row : rows) {
    const double r = std::abs(row.residual + row.J.dot(result.x));
    const double inner = std::min(r, huber);
    result.cost += row.weight * inner * (r - 0.5 * inner);
  }
  return result;
}

}  // namespace

void BlurOptions::check() const {
  require(huber > 0.0, "blur.huber", "positive");
  require(least > 0.0 && most >= least, "blur.least and most", "0 < least <= most");
  require(explained > 0.0 && explained <= 1.0, "blur.explained", "in (0, 1]");
}

std::optional<Eigen::Matrix2d> estimate_blur(const GradientImage& host, const std::vector<BrightnessSample>& samples,
                                             double gain, const BlurOptions& options) {
  if (!options.enabled) return {};
  const std::vector<Row> rows = rows_of(host, samples, gain);
  if (rows.size() < min_samples) return {};
  const BlurFit without = fit_blur(rows, 8, options.huber);
  const BlurFit with = fit_blur(rows, 11, options.huber);
  if (!with.x.allFinite() || !(with.cost < options.explained * without.cost)) return {};
  Eigen::Matrix2d covariance;
  covariance << with.x[8], with.x[9], with.x[9], with.x[10];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(covariance);
  const Eigen::Vector2d variances = eigen.eigenvalues().cwiseMax(0.0).cwiseMin(options.most);
  if (variances.maxCoeff() < options.least) return {};
  return eigen.eigenvectors() * variances.asDiagonal() * eigen.eigenvectors().transpose();
}

GrayImage apply_blur(const GrayImage& image, const Eigen::Matrix2d& covariance) {
  // A kernel much thinner than a pixel cannot be sampled: it is widened a little.
  const Eigen::Matrix2d information = (covariance + 0.02 * Eigen::Matrix2d::Identity()).inverse();
  const int reach_u = static_cast<int>(std::ceil(3.0 * std::sqrt(covariance(0, 0)))) + 1;
  const int reach_v = static_cast<int>(std::ceil(3.0 * std::sqrt(covariance(1, 1)))) + 1;
  cv::Mat1f kernel(2 * reach_v + 1, 2 * reach_u + 1);
  double sum = 0.0;
  for (int v = -reach_v; v <= reach_v; ++v) {
    for (int u = -reach_u; u <= reach_u; ++u) {
      const Eigen::Vector2d at(u, v);
      const double value = std::exp(-0.5 * at.dot(information * at));
      kernel(v + reach_v, u + reach_u) = static_cast<float>(value);
      sum += value;
    }
  }
  kernel /= sum;
  GrayImage out;
  cv::filter2D(image, out, CV_32F, kernel, {-1, -1}, 0.0, cv::BORDER_REPLICATE);
  return out;
}

}  // namespace odosplat
