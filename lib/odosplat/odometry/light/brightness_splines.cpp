// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/light/brightness_splines.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"

namespace odosplat {
namespace {

constexpr int spline_reweightings = 3;

struct SplineFit {
  Eigen::VectorXd coefficients;
  double cost = 0.0;  // robust
};

/// splines: their number, 0: the alignment alone.
SplineFit fit_splines(const std::vector<BrightnessSample>& samples, int splines, const CurveFitOptions& options) {
  const Eigen::Index size = 8 + splines;
  // Weight of the squared difference of neighbouring coefficients.
  const double alike = options.noise * options.noise / (options.sigma * options.sigma);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(size);
  const auto residual = [&](const BrightnessSample& sample) {
    double r = sample.residual + sample.by_alignment.dot(x.head<8>());
    if (splines > 0) r += sample.by_curve * sample.curve.value.dot(x.segment<4>(8 + sample.curve.first));
    return std::abs(r);
  };
  for (int pass = 0; pass < spline_reweightings; ++pass) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
    for (const BrightnessSample& sample : samples) {
      const Eigen::Matrix<double, 8, 1>& J = sample.by_alignment;
      const double w = sample.weight * options.huber / std::max(options.huber, residual(sample));
      H.topLeftCorner<8, 8>() += w * J * J.transpose();
      g.head<8>() += (w * sample.residual) * J;
      if (splines == 0) continue;
      const Eigen::Vector4d curve = sample.by_curve * sample.curve.value;
      const Eigen::Index s = 8 + sample.curve.first;
      H.block<4, 8>(s, 0) += w * curve * J.transpose();
      H.block<4, 4>(s, s) += w * curve * curve.transpose();
      g.segment<4>(s) += (w * sample.residual) * curve;
    }
    H.topRightCorner(8, splines) = H.bottomLeftCorner(splines, 8).transpose();
    for (Eigen::Index i = 8; i + 1 < size; ++i) {
      H(i, i) += alike;
      H(i + 1, i + 1) += alike;
      H(i, i + 1) -= alike;
      H(i + 1, i) -= alike;
    }
    H.bottomRightCorner(splines, splines).diagonal().array() += 1e-3 * alike;
    const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * H * scale.asDiagonal();
    x = -scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(g)));
  }
  SplineFit result;
  result.coefficients = x.tail(splines);
  for (const BrightnessSample& sample : samples) {
    const double r = residual(sample);
    const double inner = std::min(r, options.huber);
    result.cost += sample.weight * inner * (r - 0.5 * inner);
  }
  return result;
}

}  // namespace

void CurveFitOptions::check(const std::string& owner) const {
  require(spans >= 1 && spans <= 50, owner + ".spans", "1 to 50");
  require(sigma > 0.0, owner + ".sigma", "positive");
  require(noise > 0.0 && huber > 0.0, owner + ".noise and huber", "positive");
  require(explained > 0.0 && explained <= 1.0, owner + ".explained", "in (0, 1]");
}

Splines splines_at(double at, int spans) {
  const double x = std::clamp(at, 0.0, 1.0) * spans;
  const int first = std::min(static_cast<int>(x), spans - 1);
  const double t = x - first;
  const double s = 1.0 - t;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {first, Eigen::Vector4d(s * s * s, 3.0 * t3 - 6.0 * t2 + 4.0, -3.0 * t3 + 3.0 * t2 + 3.0 * t + 1.0, t3) / 6.0};
}

std::vector<BrightnessSample> brightness_samples(const TrackingReference& reference, const FramePyramid& target,
                                                 const SE3& T_target_host, const Brightness& brightness,
                                                 std::size_t level) {
  std::vector<BrightnessSample> samples;
  if (reference.levels.size() <= level || target.gray.size() <= level) return samples;
  const Camera& camera = reference.cameras[level];
  const GrayImage& image = target.gray[level];
  const double gain = std::exp(brightness.a);
  const bool rolling = !target.row_motion.isZero(0.0);
  const RowShift<double> rows(camera, target.row_motion);
  samples.reserve(reference.levels[level].size());
  for (const ReferencePoint& point : reference.levels[level]) {
    Eigen::Vector3d p = T_target_host * Eigen::Vector3d(point.x, point.y, point.z);
    if (rolling) p = rows.at(p);
    if (!(p.z() > 0.01)) continue;
    const Eigen::Vector2d uv = camera.project(p);
    if (!(uv.x() >= 1.0 && uv.y() >= 1.0 && uv.x() < image.cols - 2.0 && uv.y() < image.rows - 2.0)) continue;
    const double value = bilinear(image, static_cast<float>(uv.x()), static_cast<float>(uv.y()));
    if (value >= clipped_value) continue;
    BrightnessSample sample;
    sample.host = point.intensity;
    sample.expected = gain * point.intensity + brightness.b;
    for (int i = 0; i < 8; ++i) sample.by_alignment[i] = (i < 7 ? gain : 1.0) * point.jacobian[i];
    sample.residual = value - sample.expected;
    sample.weight = point.weight;
    sample.u = point.u;
    sample.v = point.v;
    sample.height = (uv.y() + 0.5) / image.rows;
    samples.push_back(sample);
  }
  return samples;
}

std::optional<Eigen::VectorXd> fit_curve(const std::vector<BrightnessSample>& samples, const CurveFitOptions& options) {
  const SplineFit without = fit_splines(samples, 0, options);
  const SplineFit with = fit_splines(samples, options.spans + 3, options);
  if (!with.coefficients.allFinite() || !(with.cost < options.explained * without.cost)) return {};
  return with.coefficients;
}

}  // namespace odosplat
