// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/map/interpolation_view.hpp"

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

constexpr float max_spacing_medians = 4.0F;
constexpr float border_spacings = 0.75F;   // how far a surface extends beyond its outermost points
constexpr float fallback_spacings = 3.0F;  // largest depth difference between a fitted plane's point and a pixel on it
constexpr float min_radius_px = 1.5F;
constexpr float least_width = 0.1F;  // of a triangle: twice its area over the square of its longest side
constexpr float max_weight = 2.0F;   // largest absolute weight of a point; more would extrapolate too far

// The three points between which one pixel is interpolated.
struct Triple {
  const ProjectedPoint* points[3];
  float weights[3];  // barycentric, sum 1
};

// Barycentric weights of (x, y) in the triangle; false if the triangle is too thin or the pixel too far outside it.
bool weigh(Triple& triple, float x, float y) {
  const ProjectedPoint& a = *triple.points[0];
  const ProjectedPoint& b = *triple.points[1];
  const ProjectedPoint& c = *triple.points[2];
  const float abx = b.u - a.u;
  const float aby = b.v - a.v;
  const float acx = c.u - a.u;
  const float acy = c.v - a.v;
  const float area = abx * acy - aby * acx;
  const float longest =
      std::max({abx * abx + aby * aby, acx * acx + acy * acy, (acx - abx) * (acx - abx) + (acy - aby) * (acy - aby)});
  if (!(std::abs(area) > least_width * longest)) return false;
  const float apx = x - a.u;
  const float apy = y - a.v;
  triple.weights[1] = (apx * acy - apy * acx) / area;
  triple.weights[2] = (abx * apy - aby * apx) / area;
  triple.weights[0] = 1.0F - triple.weights[1] - triple.weights[2];
  return std::all_of(triple.weights, triple.weights + 3, [](float w) { return std::abs(w) <= max_weight; });
}

// How far behind the front surface a point still counts as part of it [m].
float hidden_tolerance(const InterpolationOptions& options, const ProjectedPoint& p, float z) {
  return static_cast<float>(options.hidden_spacings) * p.spacing + static_cast<float>(options.hidden_share) * z;
}

// Column or row of the surface image in which a point lies; less than 0 outside.
int surface_index(float pixel) {
  const float shifted = pixel + static_cast<float>(projection_margin) + 0.5F;
  return shifted < 0.0F ? -1 : static_cast<int>(shifted);
}

void drop_hidden(std::vector<ProjectedPoint>& points, const cv::Mat1f& surface, const InterpolationOptions& options) {
  std::erase_if(points, [&](const ProjectedPoint& p) {
    const int x = surface_index(p.u);
    const int y = surface_index(p.v);
    if (x < 0 || y < 0 || x >= surface.cols || y >= surface.rows) return true;
    const float z = p.p_camera.z();
    return z > surface(y, x) + hidden_tolerance(options, p, z);
  });
}

struct PixelDepth {
  float z = 0.0F;  // [m], 0 = a hole
  float sigma = 0.0F;
  int nearest = 0;  // index in the cloud of the nearest point
};

// The interpolation at one pixel.
class PixelInterpolator {
 public:
  PixelInterpolator(const std::vector<ProjectedPoint>& points, const cv::Mat1f& surface,
                    const std::vector<float>& residuals, const Camera& camera, const InterpolationOptions& options)
      : points_(points),
        surface_(surface),
        residuals_(residuals),
        options_(options),
        grid_(points, camera),
        focal_(static_cast<float>(std::max(camera.fx, camera.fy))) {}

  PixelDepth at(int column, int row) const {
    const float surface = surface_(row + projection_margin, column + projection_margin);
    if (!std::isfinite(surface)) return {};
    const auto x = static_cast<float>(column);
    const auto y = static_cast<float>(row);
    const PointGrid::Found found = points_around(x, y, surface);
    if (found.count == 0) return {};
    const ProjectedPoint& first = point(found, 0);

    Triple triple{};
    const bool good = choose_triple(found, x, y, triple);
    const bool inside = good && std::all_of(triple.weights, triple.weights + 3, [](float w) { return w >= -0.05F; });
    const float border = std::max(1.0F, border_spacings * focal_ * first.spacing * first.inverse_depth);
    if (!inside && found.squared_distances[0] > border * border) return {};
    if (good && !one_surface(triple)) return {};

    const auto [inverse_depth, noise] = good ? from_triple(triple) : from_plane(first, x, y);
    if (!(inverse_depth > 0.0F) || inverse_depth * static_cast<float>(options_.min_depth) > 1.0F) return {};
    const float z = 1.0F / inverse_depth;
    return {z, std::hypot(noise, static_cast<float>(options_.sigma_share) * z), first.index};
  }

 private:
  struct Value {
    float inverse_depth;  // [1/m]
    float noise;          // [m]
  };

  const ProjectedPoint& point(const PointGrid::Found& found, int i) const {
    return points_[static_cast<std::size_t>(found.points[i])];
  }

  // The nearest points within the radius that follows from their spacing, and whose plane belongs to the front surface
  // at this pixel.
  PointGrid::Found points_around(float x, float y, float surface) const {
    const auto accept = [&](const ProjectedPoint& p, float squared_distance) {
      const float radius = std::max(
          min_radius_px, static_cast<float>(options_.max_radius_spacings) * focal_ * p.spacing * p.inverse_depth);
      return squared_distance <= radius * radius &&
             p.inverse_depth_at(x, y) * (surface + hidden_tolerance(options_, p, surface)) >= 1.0F;
    };
    return grid_.nearest(x, y, static_cast<float>(options_.max_radius_px), accept);
  }

  // The nearest point and the next two that form a triangle with usable weights.
  bool choose_triple(const PointGrid::Found& found, float x, float y, Triple& triple) const {
    triple.points[0] = &point(found, 0);
    for (int k = 2; k < found.count; ++k) {
      triple.points[2] = &point(found, k);
      for (int j = 1; j < k; ++j) {
        triple.points[1] = &point(found, j);
        if (weigh(triple, x, y)) return true;
      }
    }
    return false;
  }

  // Whether the three points can be neighbours on one surface: each lies near the planes of the other two.
  bool one_surface(const Triple& triple) const {
    const auto connected = [&](const ProjectedPoint& a, const ProjectedPoint& b) {
      const Eigen::Vector3f d = b.p_camera - a.p_camera;
      const float allowed = static_cast<float>(options_.max_gap_spacings) * std::max(a.spacing, b.spacing) +
                            static_cast<float>(options_.max_gap_share) * std::min(a.p_camera.z(), b.p_camera.z());
      return std::abs(a.n_camera.dot(d)) <= allowed && std::abs(b.n_camera.dot(d)) <= allowed;
    };
    return connected(*triple.points[0], *triple.points[1]) && connected(*triple.points[1], *triple.points[2]) &&
           connected(*triple.points[2], *triple.points[0]);
  }

  float noise_along_ray(const ProjectedPoint& p) const {
    return residuals_[static_cast<std::size_t>(p.index)] / p.cosine;
  }

  Value from_triple(const Triple& triple) const {
    Value value{0.0F, 0.0F};
    float gain = 0.0F;
    for (int i = 0; i < 3; ++i) {
      value.inverse_depth += triple.weights[i] * triple.points[i]->inverse_depth;
      value.noise += noise_along_ray(*triple.points[i]) / 3.0F;
      gain += triple.weights[i] * triple.weights[i];
    }
    value.noise *= std::sqrt(gain);
    return value;
  }

  Value from_plane(const ProjectedPoint& p, float x, float y) const {
    const float reach = fallback_spacings * p.spacing * p.inverse_depth * p.inverse_depth;
    return {std::clamp(p.inverse_depth_at(x, y), p.inverse_depth - reach, p.inverse_depth + reach),
            noise_along_ray(p) + 0.25F * p.spacing};
  }

  const std::vector<ProjectedPoint>& points_;
  const cv::Mat1f& surface_;
  const std::vector<float>& residuals_;
  const InterpolationOptions& options_;
  PointGrid grid_;
  float focal_;  // [px]
};

}  // namespace

void InterpolationOptions::check() const {
  const auto positive = [](double value, const char* name) {
    require(std::isfinite(value) && value > 0.0, name, "positive");
  };
  require(neighbors >= 3, "neighbors", "at least 3");
  positive(min_depth, "min_depth");
  positive(disc_spacings, "disc_spacings");
  positive(hidden_spacings, "hidden_spacings");
  positive(hidden_share, "hidden_share");
  positive(max_radius_px, "max_radius_px");
  positive(max_radius_spacings, "max_radius_spacings");
  positive(max_gap_spacings, "max_gap_spacings");
  positive(max_gap_share, "max_gap_share");
  positive(sigma_share, "sigma_share");
}

InterpolationView::InterpolationView(const PointCloud& cloud, const InterpolationOptions& options)
    : options_((options.check(), options)), cloud_(finite_part(cloud, CloudNormals::not_used)) {
  const std::vector<LocalPlane> planes = fit_local_planes(cloud_, options_.neighbors);
  spacings_ = point_spacings(cloud_);
  for (const LocalPlane& plane : planes) {
    cloud_.normals.push_back(plane.normal);
    residuals_.push_back(plane.residual);
  }
  if (cloud_.size() == 0) return;
  const float usual = upper_median(spacings_);
  for (float& spacing : spacings_) spacing = std::min(spacing, max_spacing_medians * usual);
}

ViewImages InterpolationView::render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) {
  camera.check();
  ViewImages images = blank_images(camera, request, cloud_.has_colors());

  std::vector<ProjectedPoint> points =
      project_points(cloud_, spacings_, camera, T_world_camera, options_.min_depth, options_.disc_spacings);
  const cv::Mat1f surface = splat_discs(points, camera, options_.disc_spacings);
  drop_hidden(points, surface, options_);
  if (points.empty()) return images;

  const PixelInterpolator interpolator(points, surface, residuals_, camera, options_);
  parallel_for(camera.height, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < camera.width; ++x) {
        const PixelDepth pixel = interpolator.at(x, y);
        if (pixel.z <= 0.0F) continue;
        images.depth(y, x) = pixel.z;
        images.sigma(y, x) = pixel.sigma;
        if (!images.alpha.empty()) images.alpha(y, x) = 1.0F;
        if (images.color.empty()) continue;
        const Eigen::Vector3f& c = cloud_.colors[static_cast<std::size_t>(pixel.nearest)];
        images.color(y, x) = cv::Vec3f(c.x(), c.y(), c.z());
      }
    }
  });
  return images;
}

}  // namespace odosplat
