// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/align/image_aligner.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/row_shift.hpp"

namespace odosplat {
namespace {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

/// Sums over one level's points at one estimate.
struct Sums {
  Matrix8d H = Matrix8d::Zero();  // of (xi, a, b), before division by the noise
  Vector8d g = Vector8d::Zero();
  double cost = 0.0;        // robust, truncated
  double squares = 0.0;     // of the inliers' residuals
  double flow_scale = 0.0;  // sum of inverse depth
  double target_sum = 0.0;
  double target_squares = 0.0;
  double host_sum = 0.0;
  double host_squares = 0.0;
  double products = 0.0;  // of target and host values
  int in_view = 0;
  int inliers = 0;
};

struct Estimate {
  SE3 T;
  Brightness brightness;
};

/// A prior of the pose. The derivative of the deviation by a step on the right is taken as the identity: the prior
/// matters only for motions that the image does not determine.
struct Tie {
  SE3 T_target_host;
  Matrix6d information = Matrix6d::Zero();
  Vector6d deviation(const SE3& T) const { return (T_target_host.inverse() * T).log(); }
  double cost(const SE3& T) const {
    const Vector6d xi = deviation(T);
    return 0.5 * xi.dot(information * xi);
  }
};

/// One pass over the points: residuals, weights and normal equations. Sums in blocks of 256 points in single
/// precision, blocks in double. place: moves a point from where the camera of the middle row sees it to where that of
/// its own row does; the derivatives are taken as those of the middle row.
template <typename Place>
Sums evaluate(const std::vector<ReferencePoint>& points, const Camera& camera, const Place& place,
              const GrayImage& image, const Estimate& at, float huber, float cutoff) {
  constexpr std::size_t block = 256;
  const Eigen::Matrix3f R = at.T.rotation_matrix().cast<float>();
  const Eigen::Vector3f t = at.T.translation().cast<float>();
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  const auto gain = static_cast<float>(std::exp(at.brightness.a));
  const auto offset = static_cast<float>(at.brightness.b);
  const float max_u = static_cast<float>(image.cols) - 2.0F;
  const float max_v = static_cast<float>(image.rows) - 2.0F;
  const float outlier_cost = huber * (cutoff - 0.5F * huber);
  const float* data = image.ptr<float>();
  const auto step = static_cast<std::ptrdiff_t>(image.step1());
  Sums sums;
  for (std::size_t begin = 0; begin < points.size(); begin += block) {
    Eigen::Matrix<float, 8, 8> H = Eigen::Matrix<float, 8, 8>::Zero();
    Eigen::Matrix<float, 8, 1> g = Eigen::Matrix<float, 8, 1>::Zero();
    float cost = 0.0F;
    float squares = 0.0F;
    float flow_scale = 0.0F;
    float target_sum = 0.0F;
    float target_squares = 0.0F;
    float host_sum = 0.0F;
    float host_squares = 0.0F;
    float products = 0.0F;
    const std::size_t end = std::min(points.size(), begin + block);
    for (std::size_t k = begin; k < end; ++k) {
      const ReferencePoint& p = points[k];
      float x = R(0, 0) * p.x + R(0, 1) * p.y + R(0, 2) * p.z + t.x();
      float y = R(1, 0) * p.x + R(1, 1) * p.y + R(1, 2) * p.z + t.y();
      float z = R(2, 0) * p.x + R(2, 1) * p.y + R(2, 2) * p.z + t.z();
      place(x, y, z);
      if (!(z > 0.01F)) continue;
      const float rz = 1.0F / z;
      const float u = fx * x * rz + cx;
      const float v = fy * y * rz + cy;
      if (!(u >= 1.0F && v >= 1.0F && u < max_u && v < max_v)) continue;
      ++sums.in_view;
      const int ui = static_cast<int>(u);
      const int vi = static_cast<int>(v);
      const float a = u - static_cast<float>(ui);
      const float b = v - static_cast<float>(vi);
      const float* r0 = data + vi * step + ui;
      const float* r1 = r0 + step;
      const float top = r0[0] + a * (r0[1] - r0[0]);
      const float bottom = r1[0] + a * (r1[1] - r1[0]);
      const float value = top + b * (bottom - top);
      target_sum += value;
      target_squares += value * value;
      host_sum += p.intensity;
      host_squares += p.intensity * p.intensity;
      products += value * p.intensity;
      const float expected = gain * p.intensity + offset;
      if (value >= clipped_value && expected >= value) {
        // Clipped, as it is expected to be: an inlier without derivatives.
        ++sums.inliers;
        continue;
      }
      const float r = value - expected;
      const float size = std::abs(r);
      if (!(size < cutoff)) {
        cost += p.weight * outlier_cost;
        continue;
      }
      ++sums.inliers;
      squares += r * r;
      flow_scale += rz;
      const bool inner = size <= huber;
      cost += p.weight * (inner ? 0.5F * r * r : huber * (size - 0.5F * huber));
      const float w = inner ? p.weight : p.weight * huber / size;
      const Eigen::Map<const Eigen::Matrix<float, 8, 1>, Eigen::Aligned16> j(p.jacobian);
      for (int c = 0; c < 8; ++c) H.col(c) += (w * j[c]) * j;
      g += (w * r) * j;
    }
    sums.H += H.cast<double>();
    sums.g += g.cast<double>();
    sums.cost += cost;
    sums.squares += squares;
    sums.flow_scale += flow_scale;
    sums.target_sum += target_sum;
    sums.target_squares += target_squares;
    sums.host_sum += host_sum;
    sums.host_squares += host_squares;
    sums.products += products;
  }
  // The template's derivatives are those of I_host; the residual holds e^a I_host.
  Vector8d scale = Vector8d::Constant(gain);
  scale[7] = 1.0;
  sums.H = scale.asDiagonal() * sums.H * scale.asDiagonal();
  sums.g = scale.asDiagonal() * sums.g;
  return sums;
}

/// The same for one level of an image.
Sums evaluate(const std::vector<ReferencePoint>& points, const FramePyramid& target, std::size_t level,
              const Camera& camera, const Estimate& at, float huber, float cutoff) {
  const GrayImage& image = target.gray[level];
  if (target.row_motion.isZero(0.0)) {
    return evaluate(
        points, camera, [](float&, float&, float&) {}, image, at, huber, cutoff);
  }
  const RowShift<float> rows(camera, target.row_motion);
  const auto place = [&rows](float& x, float& y, float& z) {
    const Eigen::Vector3f p = rows.at(Eigen::Vector3f(x, y, z));
    x = p.x();
    y = p.y();
    z = p.z();
  };
  return evaluate(points, camera, place, image, at, huber, cutoff);
}

double contrast_of(const Sums& s, double gain) {
  const double n = std::max(1, s.in_view);
  const double target = std::max(0.0, s.target_squares / n - (s.target_sum / n) * (s.target_sum / n));
  const double host = std::max(0.0, s.host_squares / n - (s.host_sum / n) * (s.host_sum / n));
  return std::sqrt(target / std::max(1e-12, gain * gain * host));
}

double correlation_of(const Sums& s) {
  const double n = std::max(1, s.in_view);
  const double target = s.target_squares / n - (s.target_sum / n) * (s.target_sum / n);
  const double host = s.host_squares / n - (s.host_sum / n) * (s.host_sum / n);
  const double together = s.products / n - (s.target_sum / n) * (s.host_sum / n);
  return target > 1e-9 && host > 1e-9 ? together / std::sqrt(target * host) : 0.0;
}

}  // namespace

void ImageAlignerOptions::check() const {
  require(huber > 0.0, "aligner.huber", "positive");
  require(cutoff >= huber, "aligner.cutoff", "at least huber");
  require(max_iterations >= 1, "aligner.max_iterations", "at least 1");
  require(converged > 0.0, "aligner.converged", "positive");
  require(min_coverage >= 0.0 && min_coverage < 1.0, "aligner.min_coverage", "in [0, 1)");
  require(max_log_gain > 0.0, "aligner.max_log_gain", "positive");
  require(gain_sigma > 0.0 && offset_sigma > 0.0, "aligner.gain_sigma and offset_sigma", "positive");
  require(noise > 0.0 && bare_noise > 0.0, "aligner.noise and bare_noise", "positive");
  row_gain.check();
}

PosePrior pose_prior(const SE3& T_target_host, double sigma_translation, double sigma_rotation) {
  PosePrior prior;
  prior.T_target_host = T_target_host;
  prior.information.diagonal().head<3>().setConstant(1.0 / (sigma_translation * sigma_translation));
  prior.information.diagonal().tail<3>().setConstant(1.0 / (sigma_rotation * sigma_rotation));
  return prior;
}

double worth(const Alignment& a) { return a.finished ? a.inlier_share * a.coverage - a.rmse : -1.0; }

ImageAligner::ImageAligner(const ImageAlignerOptions& options) : options_(options) { options_.check(); }

Alignment ImageAligner::align(const TrackingReference& reference, const FramePyramid& target,
                              const SE3& T_target_host_guess, const Brightness& brightness_guess, int coarsest,
                              int finest, const PosePrior* pose) const {
  Alignment result;
  result.T_target_host = T_target_host_guess;
  result.brightness = brightness_guess;
  Estimate estimate{T_target_host_guess, brightness_guess};
  const int top = std::min({coarsest, static_cast<int>(reference.levels.size()) - 1, target.levels() - 1});
  Vector8d prior = Vector8d::Zero();
  prior[6] = options_.noise * options_.noise / (options_.gain_sigma * options_.gain_sigma);
  prior[7] = options_.noise * options_.noise / (options_.offset_sigma * options_.offset_sigma);
  Tie known;
  const double noise = reference.bare ? options_.bare_noise : options_.noise;
  if (pose != nullptr) known = {pose->T_target_host, noise * noise * pose->information};
  const auto huber = static_cast<float>(options_.huber);
  bool any = false;
  for (int l = top; l >= finest; --l) {
    const auto level = static_cast<std::size_t>(l);
    const auto& points = reference.levels[level];
    if (points.size() < 20) continue;
    const Camera& camera = reference.cameras[level];
    const int min_in_view = std::max(20, static_cast<int>(options_.min_coverage * static_cast<double>(points.size())));
    // With a wrong guess most residuals are beyond the cut-off and have no influence: it is widened then.
    float cutoff = static_cast<float>(options_.cutoff);
    Sums sums = evaluate(points, target, level, camera, estimate, huber, cutoff);
    // A coarser level that converged to a wrong pose must not mislead the finer ones: each may start from the guess.
    if (l < top) {
      const Estimate guess{T_target_host_guess, brightness_guess};
      const Sums guess_sums = evaluate(points, target, level, camera, guess, huber, cutoff);
      if (guess_sums.in_view >= min_in_view &&
          guess_sums.cost / guess_sums.in_view < sums.cost / std::max(1, sums.in_view)) {
        estimate = guess;
        sums = guess_sums;
      }
    }
    for (int widen = 0; widen < 4 && sums.inliers < 0.4 * sums.in_view; ++widen) {
      cutoff *= 2.0F;
      sums = evaluate(points, target, level, camera, estimate, huber, cutoff);
    }
    if (sums.in_view < min_in_view) return result;
    const auto energy = [&](const Sums& s, const Estimate& e) {
      const double da = e.brightness.a - brightness_guess.a;
      const double db = e.brightness.b - brightness_guess.b;
      const double priors = 0.5 * (prior[6] * da * da + prior[7] * db * db) + known.cost(e.T);
      return s.cost / s.in_view + priors / static_cast<double>(points.size());
    };
    double current = energy(sums, estimate);
    double lambda = 1e-3;
    for (int iteration = 0; iteration < options_.max_iterations; ++iteration) {
      Matrix8d H = sums.H;
      Vector8d g = sums.g;
      H.diagonal() += prior;
      H.topLeftCorner<6, 6>() += known.information;
      g.head<6>() += known.information * known.deviation(estimate.T);
      g[6] += prior[6] * (estimate.brightness.a - brightness_guess.a);
      g[7] += prior[7] * (estimate.brightness.b - brightness_guess.b);
      Vector8d step;
      Sums next;
      Estimate candidate;
      bool accepted = false;
      for (int attempt = 0; attempt < 5 && !accepted; ++attempt) {
        Matrix8d damped = H;
        damped.diagonal() *= 1.0 + lambda;
        step = -damped.ldlt().solve(g);
        if (!step.allFinite()) return result;
        candidate.T = estimate.T * SE3::exp(step.head<6>());
        candidate.brightness.a =
            std::clamp(estimate.brightness.a + step[6], -options_.max_log_gain - 0.3, options_.max_log_gain + 0.3);
        candidate.brightness.b = estimate.brightness.b + step[7];
        next = evaluate(points, target, level, camera, candidate, huber, cutoff);
        accepted = next.in_view >= min_in_view && energy(next, candidate) <= current;
        lambda = accepted ? lambda * 0.3 : lambda * 8.0;
      }
      if (!accepted) break;
      const double motion =
          camera.fx * (step.segment<3>(3).norm() + step.head<3>().norm() * next.flow_scale / std::max(1, next.inliers));
      estimate = candidate;
      sums = next;
      current = energy(sums, estimate);
      if (motion < options_.converged) break;
    }
    any = true;
    if (!estimate.T.is_finite()) return result;
    result.T_target_host = estimate.T;
    result.brightness = estimate.brightness;
    // Quality is computed with the plain cut-off, whatever the level was run with.
    if (cutoff > static_cast<float>(options_.cutoff)) {
      sums = evaluate(points, target, level, camera, estimate, huber, static_cast<float>(options_.cutoff));
    }
    result.rmse = std::sqrt(sums.squares / std::max(1, sums.inliers));
    result.inlier_share = static_cast<double>(sums.inliers) / std::max(1, sums.in_view);
    result.coverage = static_cast<double>(sums.in_view) / static_cast<double>(points.size());
    result.contrast = contrast_of(sums, std::exp(estimate.brightness.a));
    result.correlation = correlation_of(sums);
    // Brightness is a nuisance parameter: it is eliminated from the information (Schur complement).
    Matrix8d H = sums.H;
    H.diagonal() += prior;
    const Eigen::Matrix2d B = H.bottomRightCorner<2, 2>();
    const Eigen::Matrix<double, 6, 2> C = H.topRightCorner<6, 2>();
    const Matrix6d seen = H.topLeftCorner<6, 6>() - C * B.inverse() * C.transpose();
    result.information = (seen + known.information) / (noise * noise);
  }
  result.finished = any;
  return result;
}

Alignment ImageAligner::align_best(const TrackingReference& reference, const FramePyramid& target,
                                   std::span<const SE3> guesses, const Brightness& brightness_guess) const {
  const int top = std::min(static_cast<int>(reference.levels.size()), target.levels()) - 1;
  struct Candidate {
    Alignment alignment;
    double score;
  };
  std::vector<Candidate> candidates;
  for (const SE3& guess : guesses) {
    const Alignment a = align(reference, target, guess, brightness_guess, top, top);
    candidates.push_back({a, worth(a)});
  }
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
  Alignment best;
  best.T_target_host = guesses.front();
  double best_score = -2.0;
  for (std::size_t k = 0; k < std::min<std::size_t>(3, candidates.size()); ++k) {
    if (candidates[k].score < 0.0) break;
    const Alignment& coarse = candidates[k].alignment;
    const Alignment a = align(reference, target, coarse.T_target_host, coarse.brightness, std::max(0, top - 1), 0);
    if (worth(a) > best_score) {
      best = a;
      best_score = worth(a);
    }
  }
  return best;
}

}  // namespace odosplat
