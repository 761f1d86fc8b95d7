// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/surfel_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "odosplat/cloud/local_planes.hpp"
#include "odosplat/cloud/projected_points.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/map/view_cloud.hpp"

namespace odosplat {
namespace {

constexpr int rows_a_band = 16;

// First and last column (x0, x1) and row (y0, y1) that a disc can touch; empty if last < first.
struct Box {
  int x0, x1, y0, y1;
};

Box bounds(const ProjectedPoint& p, const Camera& camera, float radius) {
  // A disc of radius r with normal n extends r sqrt(1 - n_i^2) along axis i; the depth of its near side is used, which
  // projects larger.
  const float reach_z = radius * std::sqrt(std::max(0.0F, 1.0F - p.n_camera.z() * p.n_camera.z()));
  const float z = std::max(p.p_camera.z() - reach_z, 0.5F * p.p_camera.z());
  const float share = reach_z / z;
  const auto along = [&](float normal, float focal, float ray) {
    return focal * (radius * std::sqrt(std::max(0.0F, 1.0F - normal * normal)) / z + std::abs(ray) * share) + 0.01F;
  };
  const Eigen::Vector3f ray = p.p_camera / p.p_camera.z();
  const float reach_x = along(p.n_camera.x(), static_cast<float>(camera.fx), ray.x());
  const float reach_y = along(p.n_camera.y(), static_cast<float>(camera.fy), ray.y());
  // Clamped as floats before the conversion: discs very near to the camera can exceed the range of int. The pixel
  // nearest to the centre is always included.
  const auto low = [](float a, float b) {
    return static_cast<int>(std::max(std::min(std::ceil(a), std::round(b)), 0.0F));
  };
  const auto high = [](float a, float b, int n) {
    return static_cast<int>(std::clamp(std::max(std::floor(a), std::round(b)), -1.0F, static_cast<float>(n - 1)));
  };
  return {low(p.u - reach_x, p.u), high(p.u + reach_x, p.u, camera.width), low(p.v - reach_y, p.v),
          high(p.v + reach_y, p.v, camera.height)};
}

// The nearest surfel at every pixel.
struct NearestSurfels {
  cv::Mat1f inverse_depth;  // [1/m], 0 = none
  cv::Mat1i point;          // index among the projected points
};

// Intersection of rays with one surfel. In single precision, because this is the inner loop.
class Disc {
 public:
  Disc(const ProjectedPoint& p, const Camera& camera, float radius)
      : p_(p),
        squared_radius_(radius * radius),
        ray_x_(p.p_camera.x() / p.p_camera.z()),
        ray_y_(p.p_camera.y() / p.p_camera.z()),
        inverse_fx_(static_cast<float>(1.0 / camera.fx)),
        inverse_fy_(static_cast<float>(1.0 / camera.fy)) {}

  float inverse_depth(float dx, float dy) const { return p_.inverse_depth + p_.slope_v * dy + p_.slope_u * dx; }

  // Whether the ray (dx, dy) [px] from the disc's centre hits the disc, at inverse depth w > 0.
  bool covers(float dx, float dy, float w) const {
    // Vector from the centre to the ray's point, multiplied by w to save a division.
    const float ex = ray_x_ + dx * inverse_fx_ - w * p_.p_camera.x();
    const float ey = ray_y_ + dy * inverse_fy_ - w * p_.p_camera.y();
    const float ez = 1.0F - w * p_.p_camera.z();
    return ex * ex + ey * ey + ez * ez <= squared_radius_ * w * w;
  }

 private:
  const ProjectedPoint& p_;
  float squared_radius_;
  float ray_x_;
  float ray_y_;
  float inverse_fx_;
  float inverse_fy_;
};

// Draws rows y0..y1 - 1 of the listed surfels.
void draw_band(const std::vector<ProjectedPoint>& points, const std::vector<Box>& boxes, const std::vector<int>& listed,
               const Camera& camera, float radius, int y0, int y1, NearestSurfels& out) {
  for (const int index : listed) {
    const ProjectedPoint& p = points[static_cast<std::size_t>(index)];
    const Box& box = boxes[static_cast<std::size_t>(index)];
    const Disc disc(p, camera, radius);
    for (int y = std::max(box.y0, y0); y <= std::min(box.y1, y1 - 1); ++y) {
      float* nearest = out.inverse_depth[y];
      int* owner = out.point[y];
      const float dy = static_cast<float>(y) - p.v;
      for (int x = box.x0; x <= box.x1; ++x) {
        const float dx = static_cast<float>(x) - p.u;
        const float w = disc.inverse_depth(dx, dy);
        const bool seen = w > nearest[x] && disc.covers(dx, dy, w);
        nearest[x] = seen ? w : nearest[x];
        owner[x] = seen ? index : owner[x];
      }
    }
    // A small disc may lie between pixel centres, where no ray hits it: it is drawn at the pixel nearest to its centre.
    const int x = static_cast<int>(std::clamp(std::round(p.u), -1.0F, static_cast<float>(camera.width)));
    const int y = static_cast<int>(std::clamp(std::round(p.v), -1.0F, static_cast<float>(camera.height)));
    if (y < y0 || y >= y1 || x < 0 || x >= camera.width) continue;
    const float dx = static_cast<float>(x) - p.u;
    const float dy = static_cast<float>(y) - p.v;
    const float w = disc.inverse_depth(dx, dy);
    if (w > 0.0F && disc.covers(dx, dy, w)) continue;
    const float z = p.p_camera.z();
    const float within = std::clamp(w, 1.0F / (z + radius), 1.0F / std::max(z - radius, 0.5F * z));
    if (!(within > out.inverse_depth(y, x))) continue;
    out.inverse_depth(y, x) = within;
    out.point(y, x) = index;
  }
}

NearestSurfels draw(const std::vector<ProjectedPoint>& points, const Camera& camera, float radius) {
  NearestSurfels out{cv::Mat1f(camera.height, camera.width, 0.0F), cv::Mat1i(camera.height, camera.width, -1)};
  const int bands = (camera.height + rows_a_band - 1) / rows_a_band;
  std::vector<Box> boxes(points.size());
  std::vector<std::vector<int>> listed(static_cast<std::size_t>(bands));
  for (std::size_t i = 0; i < points.size(); ++i) {
    boxes[i] = bounds(points[i], camera, radius);
    if (boxes[i].y1 < boxes[i].y0 || boxes[i].x1 < boxes[i].x0) continue;
    for (int b = boxes[i].y0 / rows_a_band; b <= boxes[i].y1 / rows_a_band; ++b) {
      listed[static_cast<std::size_t>(b)].push_back(static_cast<int>(i));
    }
  }
  parallel_for(bands, 1, [&](int begin, int end) {
    for (int b = begin; b < end; ++b) {
      draw_band(points, boxes, listed[static_cast<std::size_t>(b)], camera, radius, b * rows_a_band,
                std::min(camera.height, (b + 1) * rows_a_band), out);
    }
  });
  return out;
}

}  // namespace

void SurfelOptions::check() const {
  require(std::isfinite(radius) && radius >= 0.0, "radius", "at least 0 m");
  require(std::isfinite(radius_spacings) && radius_spacings > 0.0, "radius_spacings", "positive");
  require(neighbors >= 3, "neighbors", "at least 3");
  require(std::isfinite(min_depth) && min_depth > 0.0, "min_depth", "positive [m]");
  require(std::isfinite(sigma_share) && sigma_share > 0.0, "sigma_share", "positive");
}

SurfelView::SurfelView(const PointCloud& cloud, const SurfelOptions& options)
    : options_((options.check(), options)), cloud_(finite_part(cloud, CloudNormals::used)) {
  const std::vector<LocalPlane> planes = fit_local_planes(cloud_, options_.neighbors);
  cloud_.normals.resize(cloud_.size(), Eigen::Vector3f::Zero());
  residuals_.reserve(cloud_.size());
  for (std::size_t i = 0; i < planes.size(); ++i) {
    Eigen::Vector3f& normal = cloud_.normals[i];
    const float length = normal.norm();
    normal = std::isfinite(length) && length > 0.5F ? Eigen::Vector3f(normal / length) : planes[i].normal;
    residuals_.push_back(planes[i].residual);
  }
  radius_ = options_.radius > 0.0
                ? options_.radius
                : options_.radius_spacings * static_cast<double>(upper_median(point_spacings(cloud_)));
}

ViewImages SurfelView::render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) {
  camera.check();
  ViewImages images = blank_images(camera, request, cloud_.has_colors());

  const auto radius = static_cast<float>(radius_);
  const std::vector<ProjectedPoint> points = project_points(cloud_, std::vector<float>(cloud_.size(), radius), camera,
                                                            T_world_camera, options_.min_depth, 1.0);
  const NearestSurfels nearest = draw(points, camera, radius);
  parallel_for(camera.height, rows_a_band, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const int index = nearest.point(y, x);
        if (index < 0) continue;
        const ProjectedPoint& p = points[static_cast<std::size_t>(index)];
        const auto in_cloud = static_cast<std::size_t>(p.index);
        const float z = 1.0F / nearest.inverse_depth(y, x);
        images.depth(y, x) = z;
        images.sigma(y, x) = std::hypot(residuals_[in_cloud] / p.cosine, static_cast<float>(options_.sigma_share) * z);
        if (!images.alpha.empty()) images.alpha(y, x) = 1.0F;
        if (images.color.empty()) continue;
        const Eigen::Vector3f& c = cloud_.colors[in_cloud];
        images.color(y, x) = cv::Vec3f(c.x(), c.y(), c.z());
      }
    }
  });
  return images;
}

}  // namespace odosplat
