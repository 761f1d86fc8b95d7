// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/row_gain.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr std::size_t level = 1;   // half size: enough for a smooth curve, and forgiving where the pose is off
constexpr int least_points = 100;  // in view
constexpr int reweightings = 3;

/// The four cubic B-splines that are not zero at a place, of which the first is number `first`.
struct Splines {
  int first;
  Eigen::Vector4d value;
};

/// at: 0..1 over the rows.
Splines splines_at(double at, int spans) {
  const double x = std::clamp(at, 0.0, 1.0) * spans;
  const int first = std::min(static_cast<int>(x), spans - 1);
  const double t = x - first;
  const double s = 1.0 - t;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return {first, Eigen::Vector4d(s * s * s, 3.0 * t3 - 6.0 * t2 + 4.0, -3.0 * t3 + 3.0 * t2 + 3.0 * t + 1.0, t3) / 6.0};
}

/// One point's residual and its derivatives by pose, log gain and offset, and where it lies among the splines.
struct Row {
  Eigen::Matrix<double, 8, 1> alignment;
  double expected;
  Splines splines;
  double residual;
  double weight;
};

std::vector<Row> linearise(const TrackingReference& reference, const FramePyramid& target, const SE3& T_target_host,
                           const Brightness& brightness, int spans) {
  const Camera& camera = reference.cameras[level];
  const GrayImage& image = target.gray[level];
  const double gain = std::exp(brightness.a);
  std::vector<Row> rows;
  rows.reserve(reference.levels[level].size());
  for (const ReferencePoint& point : reference.levels[level]) {
    const Eigen::Vector3d p = T_target_host * Eigen::Vector3d(point.x, point.y, point.z);
    if (!(p.z() > 0.01)) continue;
    const Eigen::Vector2d uv = camera.project(p);
    if (!(uv.x() >= 1.0 && uv.y() >= 1.0 && uv.x() < image.cols - 2.0 && uv.y() < image.rows - 2.0)) continue;
    const double value = bilinear(image, static_cast<float>(uv.x()), static_cast<float>(uv.y()));
    if (value >= clipped_value) continue;
    Row row;
    row.expected = gain * point.intensity + brightness.b;
    for (int i = 0; i < 8; ++i) row.alignment[i] = (i < 7 ? gain : 1.0) * point.jacobian[i];
    row.splines = splines_at((uv.y() + 0.5) / image.rows, spans);
    row.residual = value - row.expected;
    row.weight = point.weight;
    rows.push_back(row);
  }
  return rows;
}

/// Change of pose, log gain and offset, then coefficients of the splines; robust cost.
struct Fit {
  Eigen::VectorXd x;
  double cost = 0.0;
};

/// splines: their number, or 0 for rows that are alike.
Fit fit(const std::vector<Row>& rows, Eigen::Index splines, const RowGainOptions& options) {
  const Eigen::Index size = 8 + splines;
  Fit result;
  result.x = Eigen::VectorXd::Zero(size);
  const auto residual = [&](const Row& row, const Eigen::Matrix<double, 12, 1>& J) {
    double r = row.residual + J.head<8>().dot(result.x.head<8>());
    if (splines > 0) r += J.tail<4>().dot(result.x.segment<4>(8 + row.splines.first));
    return std::abs(r);
  };
  const auto derivatives = [](const Row& row) {
    Eigen::Matrix<double, 12, 1> J;
    J << row.alignment, -row.expected * row.splines.value;
    return J;
  };
  for (int pass = 0; pass < reweightings; ++pass) {
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size, size);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(size);
    for (const Row& row : rows) {
      const Eigen::Matrix<double, 12, 1> J = derivatives(row);
      const double w = row.weight * options.huber / std::max(options.huber, residual(row, J));
      H.topLeftCorner<8, 8>() += w * J.head<8>() * J.head<8>().transpose();
      g.head<8>() += (w * row.residual) * J.head<8>();
      if (splines == 0) continue;
      const Eigen::Index s = 8 + row.splines.first;
      H.block<4, 8>(s, 0) += w * J.tail<4>() * J.head<8>().transpose();
      H.block<4, 4>(s, s) += w * J.tail<4>() * J.tail<4>().transpose();
      g.segment<4>(s) += (w * row.residual) * J.tail<4>();
    }
    H.topRightCorner(8, splines) = H.bottomLeftCorner(splines, 8).transpose();
    // Neighbouring coefficients are alike, and their mean, which the alignment's gain takes, is 0.
    const double alike = options.noise * options.noise / (options.sigma * options.sigma);
    for (Eigen::Index i = 8; i + 1 < size; ++i) {
      H(i, i) += alike;
      H(i + 1, i + 1) += alike;
      H(i, i + 1) -= alike;
      H(i + 1, i) -= alike;
    }
    H.bottomRightCorner(splines, splines).diagonal().array() += 1e-3 * alike;
    const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * H * scale.asDiagonal();
    result.x = -scale.cwiseProduct(scaled.ldlt().solve(scale.cwiseProduct(g)));
  }
  for (const Row& row : rows) {
    const double r = residual(row, derivatives(row));
    const double inner = std::min(r, options.huber);
    result.cost += row.weight * inner * (r - 0.5 * inner);
  }
  return result;
}

/// The splines at every row of an image, 1 added, divided by the mean.
RowGain curve(const Eigen::VectorXd& coefficients, int spans, int rows) {
  RowGain gain(static_cast<std::size_t>(rows));
  for (std::size_t v = 0; v < gain.size(); ++v) {
    const Splines at = splines_at((static_cast<double>(v) + 0.5) / rows, spans);
    const double value = 1.0 + at.value.dot(coefficients.segment<4>(at.first));
    gain[v] = static_cast<float>(std::clamp(value, 0.3, 3.0));
  }
  const double mean = std::accumulate(gain.begin(), gain.end(), 0.0) / rows;
  for (float& value : gain) value /= static_cast<float>(mean);
  return gain;
}

}  // namespace

void RowGainOptions::check() const {
  require(spans >= 1 && spans <= 50, "row_gain.spans", "1 to 50");
  require(sigma > 0.0, "row_gain.sigma", "positive");
  require(noise > 0.0 && huber > 0.0, "row_gain.noise and huber", "positive");
  require(least > 0.0, "row_gain.least", "positive");
  require(explained > 0.0 && explained <= 1.0, "row_gain.explained", "in (0, 1]");
  require(same >= 0.0, "row_gain.same", "at least 0");
}

RowGain estimate_row_gain(const TrackingReference& reference, const FramePyramid& target, const SE3& T_target_host,
                          const Brightness& brightness, const RowGainOptions& options) {
  if (reference.levels.size() <= level || target.gray.size() <= level) return {};
  const std::vector<Row> rows = linearise(reference, target, T_target_host, brightness, options.spans);
  if (rows.size() < least_points) return {};
  const Fit even = fit(rows, 0, options);
  const Fit uneven = fit(rows, options.spans + 3, options);
  if (!uneven.x.allFinite() || !(uneven.cost < options.explained * even.cost)) return {};
  RowGain gain = curve(uneven.x.tail(options.spans + 3), options.spans, target.gray.front().rows);
  if (unevenness(gain) < options.least) gain.clear();
  return gain;
}

double unevenness(const RowGain& gain) {
  double squares = 0.0;
  for (const float value : gain) squares += (value - 1.0) * (value - 1.0);
  return gain.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(gain.size()));
}

FramePyramid divide_rows(const FramePyramid& pyramid, const RowGain& gain) {
  if (gain.empty()) return pyramid;
  FramePyramid divided = pyramid;
  RowGain of_level = gain;
  for (GrayImage& image : divided.gray) {
    image = image.clone();
    for (int y = 0; y < image.rows; ++y) {
      const float factor = 1.0F / of_level[static_cast<std::size_t>(y)];
      for (int x = 0; x < image.cols; ++x) image(y, x) *= factor;
    }
    const std::size_t half = of_level.size() / 2;
    for (std::size_t y = 0; y < half; ++y) of_level[y] = 0.5F * (of_level[2 * y] + of_level[2 * y + 1]);
    of_level.resize(half);
  }
  return divided;
}

}  // namespace odosplat
