// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/sensor/kinect.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "odosplat/core/angles.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/sensor/row_random.hpp"

namespace odosplat {
namespace {

// Change of inverse depth at a pixel along one axis.
struct Slope {
  double step = 0.0;  // [1/m/px]
  bool edge = false;
};

Slope slope(double before, double here, double after, double edge_share) {
  Slope s;
  const bool has_before = before > 0.0;
  const bool has_after = after > 0.0;
  s.edge = (has_before && std::abs(here - before) > edge_share * std::max(here, before)) ||
           (has_after && std::abs(after - here) > edge_share * std::max(here, after));
  if (has_before && has_after) {
    s.step = 0.5 * (after - before);
  } else if (has_before || has_after) {
    s.step = has_after ? after - here : here - before;
  }
  return s;
}

// Whether the sensor measures a depth at a pixel of the true depth.
bool answers(const DepthImage& ideal, const Camera& camera, const KinectOptions& options, int x, int y) {
  const auto inverse_at = [&](int u, int v) {
    if (u < 0 || u >= ideal.cols || v < 0 || v >= ideal.rows || !(ideal(v, u) > 0.0F)) return 0.0;
    return 1.0 / static_cast<double>(ideal(v, u));
  };
  const double here = inverse_at(x, y);
  if (!(here > 0.0)) return false;
  const Slope across = slope(inverse_at(x - 1, y), here, inverse_at(x + 1, y), options.edge_share);
  const Slope down = slope(inverse_at(x, y - 1), here, inverse_at(x, y + 1), options.edge_share);
  if (across.edge || down.edge) return false;
  // The plane m . p = 1: its inverse depth along a ray is m . ray.
  const Eigen::Vector3d ray = camera.ray(x, y);
  Eigen::Vector3d m(across.step * camera.fx, down.step * camera.fy, 0.0);
  m.z() = here - m.x() * ray.x() - m.y() * ray.y();
  return here >= std::cos(options.max_angle_deg * radians_per_degree) * m.norm() * ray.norm();
}

}  // namespace

void KinectOptions::check() const {
  axial.check();
  require(lateral_noise >= 0.0 && lateral_noise <= 5.0, "kinect.lateral_noise", "in 0..5 px");
  require(baseline > 0.0 && std::isfinite(baseline), "kinect.baseline", "positive [m]");
  require(disparity_step > 0.0 && disparity_step <= 10.0, "kinect.disparity_step", "in 0..10 px, not 0");
  require(range_min > 0.0 && range_max > range_min, "kinect.range_max", "above range_min, which must be positive");
  require(max_angle_deg > 0.0 && max_angle_deg <= 90.0, "kinect.max_angle_deg", "in 0..90, not 0");
  require(edge_share > 0.0, "kinect.edge_share", "positive");
}

DepthImage sense_kinect_depth(const DepthImage& ideal, const Camera& camera, const KinectOptions& options, int frame) {
  options.check();
  camera.check();
  if (ideal.size() != cv::Size(camera.width, camera.height)) {
    throw InputError("depth image", "is " + std::to_string(ideal.cols) + "x" + std::to_string(ideal.rows) +
                                        ", the camera " + std::to_string(camera.width) + "x" +
                                        std::to_string(camera.height));
  }
  const double steps = kinect_focal_px * options.baseline / options.disparity_step;  // disparity at 1 m, in steps
  const double lateral = options.lateral_noise * camera.fx / kinect_focal_px;
  DepthImage out(ideal.size());
  parallel_for(ideal.rows, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      Random random = row_random(options.seed, frame, y);
      for (int x = 0; x < ideal.cols; ++x) {
        const auto dx = static_cast<int>(std::lround(lateral * random.normal()));
        const auto dy = static_cast<int>(std::lround(lateral * random.normal()));
        const double axial = random.normal();
        out(y, x) = 0.0F;
        const int u = std::clamp(x + dx, 0, ideal.cols - 1);
        const int v = std::clamp(y + dy, 0, ideal.rows - 1);
        if (!answers(ideal, camera, options, u, v)) continue;
        const double z = ideal(v, u);
        const double sigma = options.axial.sigma(z);
        const double rounding = z * z / steps;
        const double added = std::sqrt(std::max(0.0, sigma * sigma - rounding * rounding / 12.0));
        const double noisy = std::max(0.5 * z, z + added * axial);
        const double sensed = steps / std::max(1.0, std::round(steps / noisy));
        if (sensed >= options.range_min && sensed <= options.range_max) out(y, x) = static_cast<float>(sensed);
      }
    }
  });
  return out;
}

}  // namespace odosplat
