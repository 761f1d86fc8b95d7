// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/tracking_reference.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

ReferencePoint make_point(const Camera& camera, const GradientImage& gradient, const cv::Point& pixel, double q,
                          float c2) {
  const Eigen::Vector3d p = camera.ray(pixel.x, pixel.y) / q;
  const float* g = gradient.ptr<float>(pixel.y) + 4 * pixel.x;
  const Eigen::Matrix<double, 2, 6> J = projection_jacobian(camera, p);
  ReferencePoint out{};
  out.x = static_cast<float>(p.x());
  out.y = static_cast<float>(p.y());
  out.z = static_cast<float>(p.z());
  out.intensity = g[0];
  out.weight = c2 / (c2 + g[3]);
  out.u = static_cast<float>(pixel.x);
  out.v = static_cast<float>(pixel.y);
  for (int k = 0; k < 6; ++k) out.jacobian[k] = static_cast<float>(g[1] * J(0, k) + g[2] * J(1, k));
  out.jacobian[6] = -g[0];
  out.jacobian[7] = -1.0F;
  return out;
}

/// Mean inverse depth of the points that fall on each pixel of a level; without any, the mean of those on its four
/// neighbours; 0 if there are none either.
cv::Mat1f splat(const cv::Size& size, int level, std::span<const TransferredPoint> projected) {
  cv::Mat1f sum(size, 0.0F);
  cv::Mat1f count(size, 0.0F);
  for (const TransferredPoint& p : projected) {
    const int x = static_cast<int>(std::lround(p.u)) >> level;
    const int y = static_cast<int>(std::lround(p.v)) >> level;
    if (x < 1 || y < 1 || x >= size.width - 1 || y >= size.height - 1) continue;
    sum(y, x) += p.q;
    count(y, x) += 1.0F;
  }
  cv::Mat1f q(size, 0.0F);
  for (int y = 1; y < size.height - 1; ++y) {
    for (int x = 1; x < size.width - 1; ++x) {
      float s = sum(y, x);
      float n = count(y, x);
      if (!(n > 0.0F)) {
        s = sum(y - 1, x) + sum(y + 1, x) + sum(y, x - 1) + sum(y, x + 1);
        n = count(y - 1, x) + count(y + 1, x) + count(y, x - 1) + count(y, x + 1);
      }
      if (n > 0.0F) q(y, x) = s / n;
    }
  }
  return q;
}

/// Share of the regions with depth, each a tenth of the image wide, in which some pixels were picked.
double share_of_regions(const cv::Mat1b& with_depth, const std::vector<cv::Point>& pixels) {
  constexpr int least = 3;
  const int side = std::max(1, with_depth.cols / 10);
  cv::Mat1i picked((with_depth.rows + side - 1) / side, (with_depth.cols + side - 1) / side, 0);
  for (const cv::Point& p : pixels) ++picked(p.y / side, p.x / side);
  int known = 0;
  int found = 0;
  for (int y = 0; y < picked.rows; ++y) {
    for (int x = 0; x < picked.cols; ++x) {
      const cv::Rect region(x * side, y * side, side, side);
      if (cv::countNonZero(with_depth(region & cv::Rect({0, 0}, with_depth.size()))) == 0) continue;
      ++known;
      if (picked(y, x) >= least) ++found;
    }
  }
  return known > 0 ? static_cast<double>(found) / known : 1.0;
}

}  // namespace

void ReferenceOptions::check() const {
  require(points >= 50, "reference.points", "at least 50");
  require(level_share > 0.0 && level_share <= 1.0, "reference.level_share", "in (0, 1]");
  require(min_points >= 10, "reference.min_points", "at least 10");
  require(gradient_weight > 0.0, "reference.gradient_weight", "positive");
  require(min_gradient >= 0.0, "reference.min_gradient", "at least 0");
  require(bare_share >= 0.0 && bare_share <= 1.0, "reference.bare_share", "in [0, 1]");
  require(bare_factor >= 1.0, "reference.bare_factor", "at least 1");
}

int ReferenceOptions::wanted(const Camera& camera) const {
  const double area = static_cast<double>(camera.width) * camera.height / (320.0 * 240.0);
  return static_cast<int>(std::lround(points * std::sqrt(area)));
}

Eigen::Matrix<double, 2, 6> projection_jacobian(const Camera& camera, const Eigen::Vector3d& p_camera) {
  const double rz = 1.0 / p_camera.z();
  const double x = p_camera.x() * rz;
  const double y = p_camera.y() * rz;
  Eigen::Matrix<double, 2, 6> J;
  J << camera.fx * rz, 0.0, -camera.fx * x * rz, -camera.fx * x * y, camera.fx * (1.0 + x * x), -camera.fx * y,  //
      0.0, camera.fy * rz, -camera.fy * y * rz, -camera.fy * (1.0 + y * y), camera.fy * x * y, camera.fy * x;
  return J;
}

TrackingReference build_reference(const FramePyramid& pyramid, std::span<const GradientImage> gradients,
                                  const ViewImages& view, PixelSelector& selector, const ReferenceOptions& options,
                                  const MapPlaneOptions& plane_options, PixelSelector* weak) {
  TrackingReference reference;
  reference.cameras = pyramid.cameras;
  reference.levels.resize(pyramid.gray.size());
  if (view.depth.empty()) return reference;
  double wanted = options.wanted(pyramid.cameras.front());
  const float c2 = static_cast<float>(options.gradient_weight * options.gradient_weight);
  for (int l = 0; l < pyramid.levels(); ++l) {
    const auto level = static_cast<std::size_t>(l);
    const Camera& camera = pyramid.cameras[level];
    const GradientImage& gradient = gradients[level];
    const int scale = 1 << l;
    // Pixel (x, y) of this level covers [scale * x, scale * (x + 1)) of level 0; its depth is read in the middle.
    const auto full = [scale](int x) { return x * scale + scale / 2; };
    cv::Mat1b mask(gradient.rows, gradient.cols);
    for (int y = 0; y < mask.rows; ++y) {
      const float* z = view.depth[full(y)];
      for (int x = 0; x < mask.cols; ++x) mask(y, x) = z[full(x)] > 0.0F ? 1 : 0;
    }
    const auto pick = [&](PixelSelector& from, double number) {
      return from.select(gradients.subspan(level), mask, static_cast<int>(number));
    };
    std::vector<cv::Point> pixels;
    if (!reference.bare) pixels = pick(selector, wanted);
    if (l == 0 && weak != nullptr) reference.bare = share_of_regions(mask, pixels) < options.bare_share;
    if (reference.bare) pixels = pick(*weak, options.bare_factor * wanted);
    wanted = std::max<double>(options.min_points, wanted * options.level_share);
    auto& points = reference.levels[level];
    points.reserve(pixels.size());
    for (const cv::Point& pixel : pixels) {
      const auto surface =
          fit_surface(pyramid.cameras[0], view.depth, view.sigma, full(pixel.x), full(pixel.y), scale, plane_options);
      if (!surface) continue;
      const Eigen::Vector3d ray = camera.ray(pixel.x, pixel.y);
      // Depth of the fitted plane on the ray of this level's pixel: the level 0 pixel is up to half a pixel away from
      // it.
      const double q = surface->edge ? surface->inverse_depth : surface->m_camera.dot(ray);
      if (!(q > 0.0)) continue;
      points.push_back(make_point(camera, gradient, pixel, q, c2));
    }
  }
  return reference;
}

void add_projected_points(TrackingReference& reference, std::span<const GradientImage> gradients,
                          std::span<const TransferredPoint> projected, const ReferenceOptions& options) {
  if (projected.empty()) return;
  const float c2 = static_cast<float>(options.gradient_weight * options.gradient_weight);
  const float least = static_cast<float>(options.min_gradient * options.min_gradient);
  for (std::size_t level = 0; level < reference.levels.size(); ++level) {
    const GradientImage& gradient = gradients[level];
    cv::Mat1f inverse_depth = splat(gradient.size(), static_cast<int>(level), projected);
    auto& points = reference.levels[level];
    for (const ReferencePoint& p : points) inverse_depth(static_cast<int>(p.v), static_cast<int>(p.u)) = 0.0F;
    for (int y = 1; y < inverse_depth.rows - 1; ++y) {
      for (int x = 1; x < inverse_depth.cols - 1; ++x) {
        const double q = inverse_depth(y, x);
        if (!(q > 0.0) || gradient.ptr<float>(y)[4 * x + 3] < least) continue;
        points.push_back(make_point(reference.cameras[level], gradient, {x, y}, q, c2));
      }
    }
  }
}

}  // namespace odosplat
