// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/point_activation.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/odometry/reprojection.hpp"

namespace odosplat {
namespace {

/// Which parts of the newest keyframe's image have a point.
class Occupancy {
 public:
  Occupancy(const Camera& camera, int cells)
      : side_(std::max(2.0, std::sqrt(static_cast<double>(camera.width) * camera.height / cells))),
        taken_(static_cast<int>(camera.height / side_) + 1, static_cast<int>(camera.width / side_) + 1, uchar{0}) {}

  uchar& at(const Eigen::Vector2d& uv) {
    return taken_(static_cast<int>(uv.y() / side_), static_cast<int>(uv.x() / side_));
  }

 private:
  double side_;  // [px]
  cv::Mat1b taken_;
};

constexpr double border = 3.0;  // [px] of the newest keyframe, where no point is made

WindowPoint free_point(const ImmaturePoint& immature) {
  WindowPoint point;
  point.u = immature.u;
  point.v = immature.v;
  // A small plane that faces the camera.
  point.m_host = Eigen::Vector3d(0.0, 0.0, 0.5 * (immature.min_q + immature.max_q));
  point.plane_in_world = false;
  point.estimated = true;
  point.of_map = immature.of_map;
  std::copy(std::begin(immature.intensity), std::end(immature.intensity), std::begin(point.intensity));
  std::copy(std::begin(immature.weight), std::end(immature.weight), std::begin(point.weight));
  return point;
}

/// Gauss-Newton on each offset alone, keyframes held. Returns the points that came out well.
std::vector<WindowPoint> refine(std::vector<WindowPoint> points, const Window& window, std::size_t host_index,
                                const Camera& camera, const PhotometricOptions& photometric,
                                const ActivationOptions& options) {
  const Keyframe& host = *window.keyframes[host_index];
  const PoseEstimate host_pose{host.T_world_camera, host.T_world_camera, false};
  std::vector<double> H(points.size());
  for (int iteration = 0; iteration <= options.iterations; ++iteration) {
    std::fill(H.begin(), H.end(), 0.0);
    std::vector<double> g(points.size(), 0.0);
    for (WindowPoint& point : points) point.agreeing = point.contradicting = 0;
    const auto host_points = make_host_points(points, {}, camera, host_pose);
    for (std::size_t target = 0; target < window.keyframes.size(); ++target) {
      if (target == host_index) continue;
      const Keyframe& other = *window.keyframes[target];
      const PoseEstimate pose{other.T_world_camera, other.T_world_camera, false};
      std::vector<DepthTerms> terms(points.size());
      evaluate_pair(
          {points, host_points, &other.gradient, camera, host_pose, pose, host.brightness, other.brightness, 1.0},
          photometric, terms);
      for (std::size_t i = 0; i < points.size(); ++i) {
        points[i].agreeing += terms[i].inlier ? 1 : 0;
        points[i].contradicting += terms[i].outlier ? 1 : 0;
        H[i] += terms[i].H;
        g[i] += terms[i].g;
      }
    }
    if (iteration == options.iterations) break;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (H[i] > 0.0) points[i].offset -= g[i] / (1.05 * H[i]);
    }
  }
  std::vector<WindowPoint> good;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const WindowPoint& p = points[i];
    const double q = p.m_host.z() + p.offset;
    if (q > 1e-3 && std::isfinite(q) && H[i] >= options.min_information && p.agreeing > p.contradicting) {
      good.push_back(p);
    }
  }
  return good;
}

}  // namespace

void ActivationOptions::check() const {
  require(active_points >= 0, "activation.active_points", "at least 0");
  require(max_length > 0.0, "activation.max_length", "positive");
  require(min_quality >= 1.0, "activation.min_quality", "at least 1");
  require(min_information > 0.0, "activation.min_information", "positive");
  require(iterations >= 0, "activation.iterations", "at least 0");
}

int activate_points(Window& window, const Camera& camera, const PhotometricOptions& photometric,
                    const ActivationOptions& options) {
  const std::size_t n = window.keyframes.size();
  const bool any =
      std::any_of(window.keyframes.begin(), window.keyframes.end(), [](const auto& k) { return !k->immature.empty(); });
  if (n < 2 || !any || options.active_points == 0) return 0;
  const SE3 T_newest_world = window.keyframes.back()->T_world_camera.inverse();
  Occupancy occupancy(camera, options.active_points);
  for (const auto& host : window.keyframes) {
    const SE3 T_newest_host = T_newest_world * host->T_world_camera;
    for (const WindowPoint& point : host->points) {
      const double q = inverse_depth(point, camera, host->T_world_camera);
      if (const auto seen = reproject(camera, T_newest_host, point.u, point.v, q, border)) occupancy.at(seen->uv) = 1;
    }
  }
  std::vector<std::vector<WindowPoint>> chosen(n);
  // Newest hosts first: their points look most like the frames to come.
  for (std::size_t k = n - 1; k-- > 0;) {
    Keyframe& host = *window.keyframes[k];
    const SE3 T_newest_host = T_newest_world * host.T_world_camera;
    std::erase_if(host.immature, [&](const ImmaturePoint& p) {
      if (p.found == 0 || p.length > options.max_length || p.quality < options.min_quality) return false;
      const auto seen = reproject(camera, T_newest_host, p.u, p.v, 0.5 * (p.min_q + p.max_q), border);
      if (!seen || occupancy.at(seen->uv) != 0) return false;
      occupancy.at(seen->uv) = 1;
      chosen[k].push_back(free_point(p));
      return true;
    });
  }
  std::vector<std::vector<WindowPoint>> good(n);
  parallel_for(static_cast<int>(n), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!chosen[k].empty()) good[k] = refine(std::move(chosen[k]), window, k, camera, photometric, options);
    }
  });
  int made = 0;
  for (std::size_t k = 0; k < n; ++k) {
    auto& points = window.keyframes[k]->points;
    points.insert(points.end(), good[k].begin(), good[k].end());
    made += static_cast<int>(good[k].size());
  }
  return made;
}

void remove_bad_points(Window& window, const Camera& camera) {
  for (const auto& host : window.keyframes) {
    std::erase_if(host->points, [&](const WindowPoint& p) {
      if (!p.estimated) return false;
      const double q = inverse_depth(p, camera, host->T_world_camera);
      if (!(q > 1e-3) || !std::isfinite(q)) return true;
      return p.contradicting > p.agreeing;
    });
  }
}

}  // namespace odosplat
