// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/points/map_plane.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

struct Neighbour {
  double du, dv, q;  // [px], [px], [1/m]
};

}  // namespace

void MapPlaneOptions::check() const {
  require(radius >= 1 && radius <= 4, "plane.radius", "1 to 4 px");
  require(same_surface > 0.0, "plane.same_surface", "positive");
  require(min_support > 0.0 && min_support <= 1.0, "plane.min_support", "in (0, 1]");
  require(max_relative_sigma > 0.0, "plane.max_relative_sigma", "positive");
  require(relative_floor >= 0.0, "plane.relative_floor", "at least 0");
  require(min_cosine >= 0.0 && min_cosine < 1.0, "plane.min_cosine", "in [0, 1)");
}

std::optional<SurfacePoint> fit_surface(const Camera& camera, const DepthImage& depth, const cv::Mat1f& sigma, int x,
                                        int y, int stride, const MapPlaneOptions& options) {
  constexpr std::size_t capacity = 81;
  std::array<Neighbour, capacity> window{};
  std::size_t n = 0;
  double nearest = 0.0;  // largest inverse depth among the pixel and its direct neighbours
  for (int j = -options.radius; j <= options.radius; ++j) {
    const int v = y + j * stride;
    if (v < 0 || v >= depth.rows) continue;
    for (int i = -options.radius; i <= options.radius; ++i) {
      const int u = x + i * stride;
      if (u < 0 || u >= depth.cols) continue;
      const float z = depth(v, u);
      if (!(z > 0.0F)) continue;
      const double q = 1.0 / z;
      window[n++] = {static_cast<double>(u - x), static_cast<double>(v - y), q};
      if (std::abs(i) <= 1 && std::abs(j) <= 1) nearest = std::max(nearest, q);
    }
  }
  if (n < 6 || !(depth(y, x) > 0.0F)) return std::nullopt;
  // The pixel's own surface, unless a clearly nearer one is next to it.
  const double own = 1.0 / depth(y, x);
  const bool behind = nearest > own * (1.0 + 2.0 * options.same_surface);
  const double seed = behind ? nearest : own;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double squares = 0.0;
  std::size_t used = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const Neighbour& w = window[k];
    if (std::abs(w.q - seed) > options.same_surface * seed) continue;
    const Eigen::Vector3d row(w.du, w.dv, 1.0);
    A += row * row.transpose();
    b += row * w.q;
    squares += w.q * w.q;
    ++used;
  }
  const bool edge = behind || used < n;
  const int side = 2 * options.radius + 1;
  if (static_cast<double>(used) < options.min_support * side * side) return std::nullopt;
  const Eigen::LDLT<Eigen::Matrix3d> solver(A);
  const double spread = std::min(A(0, 0), A(1, 1));
  Eigen::Vector3d line = solver.solve(b);  // q = line . (du, dv, 1)
  const bool flat = used < 6 || spread < static_cast<double>(used) * 0.25 * stride * stride || !line.allFinite();
  double variance = 0.0;
  if (!flat) {
    variance = std::max(0.0, squares - line.dot(b)) / static_cast<double>(used);
  }
  const double q = flat ? seed : line.z();
  if (!(q > 0.0)) return std::nullopt;
  Eigen::Vector3d m(0.0, 0.0, q);
  const Eigen::Vector3d ray = camera.ray(x, y);
  if (!flat) {
    m << line.x() * camera.fx, line.y() * camera.fy, 0.0;
    m.z() = q - m.x() * ray.x() - m.y() * ray.y();
    // Of a plane seen nearly edge-on, the fitted slope is noise: it is taken as facing the camera.
    if (std::abs(m.dot(ray)) < options.min_cosine * m.norm() * ray.norm()) m = {0.0, 0.0, q};
  }
  double own_sigma = options.relative_floor / q;
  if (!sigma.empty()) own_sigma = std::max(own_sigma, static_cast<double>(sigma(y, x)));
  if (own_sigma * q > options.max_relative_sigma) return std::nullopt;
  const double sigma_q = std::sqrt(own_sigma * own_sigma * q * q * q * q + variance);
  return SurfacePoint{m, q, sigma_q, edge};
}

Plane world_plane(const Eigen::Vector3d& m_camera, const SE3& T_world_camera) {
  const Eigen::Vector3d N = T_world_camera.rotation() * m_camera;
  return {N, 1.0 + N.dot(T_world_camera.translation())};
}

Eigen::Vector3d plane_in_camera(const Plane& plane_world, const SE3& T_world_camera) {
  const double distance = plane_world.D - plane_world.N.dot(T_world_camera.translation());
  return T_world_camera.rotation().conjugate() * plane_world.N / distance;
}

}  // namespace odosplat
