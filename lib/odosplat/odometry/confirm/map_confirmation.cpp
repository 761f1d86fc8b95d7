// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/map_confirmation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/frame/tracking_reference.hpp"

namespace odosplat {
namespace {

using Values = std::array<float, patch_pixels>;

/// The square less its mean and its slope along both sides. Returns its length before it is scaled to 1.
float remove_plane(Values& values) {
  constexpr float middle = 0.5F * (patch_side - 1);
  // Sum of squared distances from the middle over the square, along one side.
  constexpr float moment = patch_pixels * (patch_pixels - 1) / 12.0F;
  float mean = 0.0F;
  float along_u = 0.0F;
  float along_v = 0.0F;
  for (int k = 0; k < patch_pixels; ++k) {
    const float u = static_cast<float>(k % patch_side) - middle;
    const float v = static_cast<float>(k / patch_side) - middle;
    const float value = values[static_cast<std::size_t>(k)];
    mean += value;
    along_u += u * value;
    along_v += v * value;
  }
  mean /= patch_pixels;
  along_u /= moment;
  along_v /= moment;
  float squares = 0.0F;
  for (int k = 0; k < patch_pixels; ++k) {
    const float u = static_cast<float>(k % patch_side) - middle;
    const float v = static_cast<float>(k / patch_side) - middle;
    float& value = values[static_cast<std::size_t>(k)];
    value -= mean + along_u * u + along_v * v;
    squares += value * value;
  }
  return std::sqrt(squares);
}

float length_of_spread(double spread) { return static_cast<float>(patch_side * spread); }

/// Least variance that is assumed of one normalised grey value: that of squares that correlate by 0.97, as in the best
/// maps.
constexpr double least_noise = 1e-3;

/// Least spread that a square is divided by, so that the correlation of two squares that hardly vary is close to 0, not
/// a ratio of rounding errors.
constexpr double least_spread = 0.5 / 255;

/// Depth of every pixel of a square; what has none gets the mean of the others. False: too few have.
bool depths_of(const DepthImage& depth, int left, int top, int step, Values& z) {
  constexpr int enough = 6 * patch_pixels / 10;
  float sum = 0.0F;
  int known = 0;
  for (int k = 0; k < patch_pixels; ++k) {
    const float value = depth((top + k / patch_side) * step + step / 2, (left + k % patch_side) * step + step / 2);
    z[static_cast<std::size_t>(k)] = value;
    if (!(value > 0.0F)) continue;
    sum += value;
    ++known;
  }
  if (known < enough) return false;
  for (float& value : z) {
    if (!(value > 0.0F)) value = sum / static_cast<float>(known);
  }
  return true;
}

}  // namespace

void ConfirmationOptions::check() const {
  require(width >= 2 * patch_side, "confirmation.width", "at least 16 px");
  require(min_texture > 0.0, "confirmation.min_texture", "positive");
  require(min_patches >= 1, "confirmation.min_patches", "at least 1");
  require(min_share >= 0.0 && min_share <= 1.0, "confirmation.min_share", "in [0, 1]");
  require(null_common > 0.0 && null_patch >= 0.0, "confirmation.null_common and null_patch", "positive");
  require(prior > 0.0 && prior < 1.0, "confirmation.prior", "in (0, 1)");
  require(confirmed > 0.0 && confirmed < 1.0, "confirmation.confirmed", "in (0, 1)");
  require(contradicted >= 0.0 && contradicted <= confirmed, "confirmation.contradicted", "in [0, confirmed]");
}

double confirmation_probability(double score, int patches, const ConfirmationOptions& options) {
  if (patches == 0) return 0.0;
  const double variance = options.null_common * options.null_common + options.null_patch * options.null_patch / patches;
  // A negative score counts as 0.
  const double s = std::max(0.0, score);
  const double log_null = -0.5 * s * s / variance - 0.5 * std::log(2.0 * std::numbers::pi * variance);
  const double log_odds = std::log(options.prior / (1.0 - options.prior)) - log_null;
  return 1.0 / (1.0 + std::exp(-log_odds));
}

ViewPatches::ViewPatches(const Camera& camera, const RenderedView& view, double smoothing,
                         const ConfirmationOptions& options)
    : options_(options), T_world_view_(view.T_world_camera) {
  options_.check();
  if (view.images.color.empty()) return;
  const FramePyramid pyramid = build_frame_pyramid(camera, to_gray(view.images.color), smoothing);
  int finest = 0;
  while (finest + 1 < pyramid.levels() && pyramid.cameras[static_cast<std::size_t>(finest)].width > options.width) {
    ++finest;
  }
  for (int number = finest; number < std::min(finest + 2, pyramid.levels()); ++number) {
    const GrayImage& gray = pyramid.gray[static_cast<std::size_t>(number)];
    const Camera& small = pyramid.cameras[static_cast<std::size_t>(number)];
    Level level;
    level.number = number;
    level.cells = (gray.cols / patch_side) * (gray.rows / patch_side);
    for (int top = 0; top + patch_side <= gray.rows; top += patch_side) {
      for (int left = 0; left + patch_side <= gray.cols; left += patch_side) {
        Patch patch;
        if (!depths_of(view.images.depth, left, top, 1 << number, patch.z)) continue;
        for (int k = 0; k < patch_pixels; ++k) {
          const auto i = static_cast<std::size_t>(k);
          const int u = left + k % patch_side;
          const int v = top + k / patch_side;
          const Eigen::Vector3d ray = small.ray(u, v);
          patch.x[i] = static_cast<float>(ray.x()) * patch.z[i];
          patch.y[i] = static_cast<float>(ray.y()) * patch.z[i];
          patch.shape[i] = gray(v, u);
        }
        const float length = remove_plane(patch.shape);
        patch.textured = length >= length_of_spread(options.min_texture);
        const float scale = 1.0F / std::max(length, length_of_spread(least_spread));
        for (float& value : patch.shape) value *= scale;
        level.patches.push_back(patch);
      }
    }
    levels_.push_back(std::move(level));
  }
}

MapEvidence ViewPatches::compare(const Level& level, const FramePyramid& image, const SE3& T_camera_view) const {
  const auto number = static_cast<std::size_t>(level.number);
  const GrayImage& gray = image.gray[number];
  const Camera& camera = image.cameras[number];
  const Eigen::Matrix3f R = T_camera_view.rotation().toRotationMatrix().cast<float>();
  const Eigen::Vector3f t = T_camera_view.translation().cast<float>();
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  const auto right = static_cast<float>(gray.cols - 1);
  const auto bottom = static_cast<float>(gray.rows - 1);
  MapEvidence evidence;
  int in_view = 0;
  double sum = 0.0;
  Values values;
  for (const Patch& patch : level.patches) {
    bool inside = true;
    for (std::size_t i = 0; i < patch_pixels && inside; ++i) {
      const Eigen::Vector3f p = R * Eigen::Vector3f(patch.x[i], patch.y[i], patch.z[i]) + t;
      const float u = fx * p.x() / p.z() + cx;
      const float v = fy * p.y() / p.z() + cy;
      inside = p.z() > 0.01F && u >= 0.0F && v >= 0.0F && u <= right && v <= bottom;
      if (inside) values[i] = bilinear(gray, u, v);
    }
    if (!inside) continue;
    ++in_view;
    const float length = remove_plane(values);
    if (!patch.textured && length < length_of_spread(options_.min_texture)) continue;
    double product = 0.0;
    for (std::size_t i = 0; i < patch_pixels; ++i) product += static_cast<double>(patch.shape[i] * values[i]);
    sum += product / std::max(length, length_of_spread(least_spread));
    ++evidence.patches;
  }
  evidence.share = static_cast<double>(in_view) / std::max(1, level.cells);
  if (evidence.patches > 0) evidence.score = sum / evidence.patches;
  evidence.probability = confirmation_probability(evidence.score, evidence.patches, options_);
  return evidence;
}

MisfitSystem ViewPatches::misfit(const FramePyramid& image, const SE3& T_camera_world,
                                 const CameraCorrection& correction, int coarse, double min_patch) const {
  MisfitSystem system;
  if (levels_.empty()) return system;
  const Level& level = levels_[std::min(static_cast<std::size_t>(coarse), levels_.size() - 1)];
  const GrayImage& gray = image.gray[static_cast<std::size_t>(level.number)];
  const Camera& camera = image.cameras[static_cast<std::size_t>(level.number)];
  const SE3 T_camera_view = T_camera_world * T_world_view_;
  const Eigen::Matrix3d R = T_camera_view.rotation().toRotationMatrix();
  const Eigen::Vector3d t = T_camera_view.translation();
  Values values;
  Values along_u;
  Values along_v;
  double squares = 0.0;
  double weights = 0.0;
  for (const Patch& patch : level.patches) {
    if (!patch.textured) continue;
    bool inside = true;
    Eigen::Matrix<double, 2, 10> jacobian = Eigen::Matrix<double, 2, 10>::Zero();
    for (std::size_t i = 0; i < patch_pixels && inside; ++i) {
      const Eigen::Vector3d p = R * Eigen::Vector3d(patch.x[i], patch.y[i], patch.z[i]) + t;
      const double x = p.x() / p.z();
      const double y = p.y() / p.z();
      const double r2 = x * x + y * y;
      const double stretch = (1.0 + correction.focal) * (1.0 + correction.radial * r2);
      const double u = camera.fx * (stretch * x + correction.center_u) + camera.cx;
      const double v = camera.fy * (stretch * y + correction.center_v) + camera.cy;
      inside = p.z() > 0.01 && u >= 1.0 && v >= 1.0 && u <= gray.cols - 2 && v <= gray.rows - 2;
      if (!inside) break;
      const auto uf = static_cast<float>(u);
      const auto vf = static_cast<float>(v);
      values[i] = bilinear(gray, uf, vf);
      along_u[i] = bilinear(gray, uf + 0.5F, vf) - bilinear(gray, uf - 0.5F, vf);
      along_v[i] = bilinear(gray, uf, vf + 0.5F) - bilinear(gray, uf, vf - 0.5F);
      if (i != patch_pixels / 2 + patch_side / 2) continue;
      jacobian.leftCols<6>() = stretch * projection_jacobian(camera, p);
      jacobian.col(6) = Eigen::Vector2d(camera.fx * x, camera.fy * y) * (1.0 + correction.radial * r2);
      jacobian.col(7) = Eigen::Vector2d(camera.fx, 0.0);
      jacobian.col(8) = Eigen::Vector2d(0.0, camera.fy);
      jacobian.col(9) = Eigen::Vector2d(camera.fx * x, camera.fy * y) * (1.0 + correction.focal) * r2;
    }
    if (!inside) continue;
    const float length = remove_plane(values);
    if (length < length_of_spread(options_.min_texture)) continue;
    remove_plane(along_u);
    remove_plane(along_v);
    double correlation = 0.0;
    double u_along = 0.0;
    double v_along = 0.0;
    for (std::size_t i = 0; i < patch_pixels; ++i) {
      values[i] /= length;
      along_u[i] /= length;
      along_v[i] /= length;
      correlation += static_cast<double>(values[i] * patch.shape[i]);
      u_along += static_cast<double>(values[i] * along_u[i]);
      v_along += static_cast<double>(values[i] * along_v[i]);
    }
    if (correlation < min_patch) continue;
    // Derivatives of the normalised values by the shift: the image's, less their component along the values themselves.
    Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
    Eigen::Vector2d b = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < patch_pixels; ++i) {
      const double value = values[i];
      const Eigen::Vector2d g(along_u[i] - u_along * value, along_v[i] - v_along * value);
      A += g * g.transpose();
      b += g * (static_cast<double>(patch.shape[i]) - value);
    }
    const double weight = correlation * correlation;
    system.information += weight * jacobian.transpose() * A * jacobian;
    system.vector += weight * jacobian.transpose() * b;
    squares += weight * 2.0 * (1.0 - correlation);
    weights += weight * (patch_pixels - 3);
    ++system.patches;
  }
  system.noise = weights > 0.0 ? std::max(least_noise, squares / weights) : 1.0;
  return system;
}

MapEvidence ViewPatches::compare(const FramePyramid& image, const SE3& T_world_camera) const {
  const SE3 T_camera_view = T_world_camera.inverse() * T_world_view_;
  MapEvidence best;
  for (const Level& level : levels_) {
    MapEvidence evidence = compare(level, image, T_camera_view);
    if (evidence.patches < options_.min_patches || evidence.share < options_.min_share) {
      best.share = std::max(best.share, evidence.share);
      continue;
    }
    evidence.verdict = evidence.probability >= options_.confirmed     ? Confirmation::confirmed
                       : evidence.probability < options_.contradicted ? Confirmation::contradicted
                                                                      : Confirmation::undecided;
    if (best.verdict == Confirmation::none || evidence.probability > best.probability) best = evidence;
    if (evidence.verdict == Confirmation::confirmed) break;
  }
  if (best.verdict == Confirmation::none) best.probability = 0.0;
  return best;
}

}  // namespace odosplat
