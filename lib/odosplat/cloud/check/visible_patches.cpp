// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/visible_patches.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/cloud/projected_points.hpp"

namespace odosplat {
namespace {

constexpr int pixels = visible_patch_side * visible_patch_side;
constexpr double least_contrast = 3.0 / 255.0;
constexpr double min_depth = 0.1;  // [m]
// On a square grid discs leave no gaps from a radius of 0.71 grid spacings on. `spacing`, the mean distance to six
// neighbours, is larger than the grid spacing.
constexpr double disc_reach = 1.0;
constexpr int match_steps = 12;
constexpr double match_ends = 0.01;  // [px]
constexpr double least_correlation = 0.8;

using Values = std::array<float, pixels>;
using Places = std::array<Eigen::Vector2f, pixels>;

template <typename Visit>
void for_each_offset(const Visit& visit) {
  std::size_t k = 0;
  for (int dy = -patch_reach; dy <= patch_reach; dy += patch_step) {
    for (int dx = -patch_reach; dx <= patch_reach; dx += patch_step) visit(k++, dx, dy);
  }
}

Values values_of(const VisiblePatch& patch, const GrayImage& image) {
  Values values;
  for_each_offset([&](std::size_t k, int dx, int dy) { values[k] = image(patch.y + dy, patch.x + dx); });
  return values;
}

// Normalises to mean 0 and sum of squares 1; false if the contrast is below `least`.
bool normalise(Values& values, double least) {
  double mean = 0.0;
  for (const float v : values) mean += v;
  mean /= pixels;
  double squares = 0.0;
  for (const float v : values) squares += (v - mean) * (v - mean);
  if (!(squares > least * least * pixels)) return false;
  const double inverse = 1.0 / std::sqrt(squares);
  for (float& v : values) v = static_cast<float>((v - mean) * inverse);
  return true;
}

double correlation(const Values& a, const Values& b) {
  double sum = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += static_cast<double>(a[k]) * static_cast<double>(b[k]);
  return sum;
}

// Projects the patch's pixels into the other camera; false if its plane is not in front of both cameras.
bool project_patch(const VisiblePatch& patch, const Camera& camera, const SE3& T_other_image, Places& places) {
  const Eigen::Matrix3d R = T_other_image.rotation_matrix();
  const Eigen::Vector3d& t = T_other_image.translation();
  bool before = true;
  for_each_offset([&](std::size_t k, int dx, int dy) {
    const double w =
        patch.inverse_depth + patch.slope_u * static_cast<float>(dx) + patch.slope_v * static_cast<float>(dy);
    const Eigen::Vector3d p = R * camera.ray(patch.x + dx, patch.y + dy) + w * t;
    before = before && w > 0.0 && p.z() > 1e-3;
    if (before) places[k] = camera.project(p).cast<float>();
  });
  return before;
}

bool inside(const Eigen::Vector2f& place, const GrayImage& image) {
  return place.x() >= 1.0F && place.y() >= 1.0F && place.x() <= static_cast<float>(image.cols - 2) &&
         place.y() <= static_cast<float>(image.rows - 2);
}

bool values_at(const Places& places, const Eigen::Vector2f& shift, const GrayImage& image, Values& values) {
  for (std::size_t k = 0; k < places.size(); ++k) {
    const Eigen::Vector2f place = places[k] + shift;
    if (!inside(place, image)) return false;
    values[k] = bilinear(image, place.x(), place.y());
  }
  return true;
}

}  // namespace

std::vector<VisiblePatch> visible_patches(const PointCloud& cloud, const std::vector<float>& spacings,
                                          const GrayImage& image, const Camera& camera, const SE3& T_world_camera,
                                          int most) {
  const std::vector<ProjectedPoint> points =
      project_points(cloud, spacings, camera, T_world_camera, min_depth, disc_reach);
  const cv::Mat1f nearest = splat_discs(points, camera, disc_reach);
  cv::Mat1b taken(image.size(), std::uint8_t{0});
  std::vector<VisiblePatch> patches;
  for (const ProjectedPoint& p : points) {
    const float right = static_cast<float>(image.cols - 1 - patch_reach);
    const float bottom = static_cast<float>(image.rows - 1 - patch_reach);
    if (!(p.u >= patch_reach && p.v >= patch_reach && p.u <= right && p.v <= bottom)) continue;
    const int x = static_cast<int>(std::lround(p.u));
    const int y = static_cast<int>(std::lround(p.v));
    if (taken(y, x) != 0) continue;
    const float front = nearest(y + projection_margin, x + projection_margin);
    if (p.p_camera.z() > 1.02F * front + 0.5F * p.spacing) continue;
    const float w = p.inverse_depth_at(static_cast<float>(x), static_cast<float>(y));
    if (!(w > 0.0F)) continue;
    VisiblePatch patch{x, y, w, p.slope_u, p.slope_v, p.index};
    Values values = values_of(patch, image);
    if (!normalise(values, least_contrast)) continue;
    taken(y, x) = 1;
    patches.push_back(patch);
  }
  const auto wanted = static_cast<std::size_t>(most);
  if (patches.size() <= wanted) return patches;
  std::vector<VisiblePatch> picked;
  for (std::size_t k = 0; k < wanted; ++k) picked.push_back(patches[k * patches.size() / wanted]);
  return picked;
}

std::optional<double> patch_difference(const VisiblePatch& patch, const GrayImage& image, const GrayImage& other,
                                       const Camera& camera, const SE3& T_other_image) {
  Places places;
  Values there;
  if (!project_patch(patch, camera, T_other_image, places)) return std::nullopt;
  if (!values_at(places, Eigen::Vector2f::Zero(), other, there)) return std::nullopt;
  Values here = values_of(patch, image);
  // Without contrast in the other image the two count as unrelated.
  if (!normalise(here, 0.0) || !normalise(there, 0.25 * least_contrast)) return 1.0;
  return 1.0 - correlation(here, there);
}

std::optional<PatchMatch> match_patch(const VisiblePatch& patch, const GrayImage& image, const GrayImage& other,
                                      const Camera& camera, const SE3& T_other_image, double most_shift,
                                      const std::optional<Eigen::Vector2d>& search_from) {
  Places places;
  if (!project_patch(patch, camera, T_other_image, places)) return std::nullopt;
  Values here = values_of(patch, image);
  if (!normalise(here, 0.0)) return std::nullopt;
  const Eigen::Vector2f first_shift =
      search_from ? Eigen::Vector2f(search_from->cast<float>() - places[pixels / 2]) : Eigen::Vector2f::Zero().eval();
  Eigen::Vector2f shift = first_shift;
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
  for (int step = 0;; ++step) {
    Values there;
    std::array<Values, 2> slopes;
    if (!values_at(places, shift, other, there)) return std::nullopt;
    double mean = 0.0;
    double squares = 0.0;
    for (const float v : there) mean += v / pixels;
    for (const float v : there) squares += (v - mean) * (v - mean);
    if (!(squares > 0.0625 * least_contrast * least_contrast * pixels)) return std::nullopt;
    const double inverse = 1.0 / std::sqrt(squares);
    if (!normalise(there, 0.0)) return std::nullopt;
    const bool found = correlation(here, there) >= least_correlation;
    if (step == match_steps && !found) return std::nullopt;
    // Gradients of the grey values divided by their contrast. Their mean is removed, since brightness is free.
    for (std::size_t axis = 0; axis < 2; ++axis) {
      Eigen::Vector2f half = Eigen::Vector2f::Zero();
      half[static_cast<Eigen::Index>(axis)] = 0.5F;
      double mean_slope = 0.0;
      for (std::size_t k = 0; k < places.size(); ++k) {
        const Eigen::Vector2f a = places[k] + shift + half;
        const Eigen::Vector2f b = places[k] + shift - half;
        slopes[axis][k] = bilinear(other, a.x(), a.y()) - bilinear(other, b.x(), b.y());
        mean_slope += slopes[axis][k] / pixels;
      }
      for (float& s : slopes[axis]) s = static_cast<float>((s - mean_slope) * inverse);
    }
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    information.setZero();
    for (std::size_t k = 0; k < places.size(); ++k) {
      const Eigen::Vector2d g(slopes[0][k], slopes[1][k]);
      information += g * g.transpose();
      right += g * static_cast<double>(here[k] - there[k]);
    }
    // Along an edge the position is undetermined: damping restricts the step to the direction across it.
    const Eigen::Matrix2d damped = information + (1e-3 * information.trace() + 1e-12) * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d change = damped.inverse() * right;
    const bool settled = change.norm() < match_ends;
    if (settled || step == match_steps) {
      if (!found) return std::nullopt;
      break;
    }
    // At most one pixel per step, since gradients are valid only near the current position.
    shift += (change / std::max(1.0, change.norm())).cast<float>();
    if ((shift - first_shift).norm() > static_cast<float>(most_shift)) return std::nullopt;
  }
  const Eigen::Vector2f middle = places[pixels / 2];
  return PatchMatch{middle.cast<double>(), (middle + shift).cast<double>(), information};
}

}  // namespace odosplat
