// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/camera/register_depth.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

// Largest relative step of depth between neighbouring pixels of one surface: at the focal lengths of depth cameras a
// wall has such steps only where it is seen at less than 3 degrees.
constexpr double largest_step = 0.05;
constexpr double nearest = 0.05;  // [m] in the colour camera
// [px^2] Rounding of an edge's two sides must not leave out a pixel that lies on it.
constexpr double on_edge = -1e-9;

/// A depth pixel in the colour camera: place in its image [px], inverse depth [1/m], and the measured depth.
struct Vertex {
  double u = 0.0;
  double v = 0.0;
  double q = 0.0;  // 0: none
  float depth = 0.0F;
};

std::vector<Vertex> project(const DepthImage& depth, const Camera& depth_camera, const SE3& T_color_depth,
                            const Camera& color_camera) {
  std::vector<Vertex> vertices(depth.total());
  const Eigen::Matrix3d R = T_color_depth.rotation_matrix();
  const Eigen::Vector3d& t = T_color_depth.translation();
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const float z = depth(y, x);
      if (!(z > 0.0F)) continue;
      const Eigen::Vector3d p = R * (static_cast<double>(z) * depth_camera.ray(x, y)) + t;
      if (!(p.z() > nearest)) continue;
      const Eigen::Vector2d at = color_camera.project(p);
      vertices[static_cast<std::size_t>(y) * static_cast<std::size_t>(depth.cols) + static_cast<std::size_t>(x)] = {
          at.x(), at.y(), 1.0 / p.z(), z};
    }
  }
  return vertices;
}

bool of_one_surface(const Vertex& a, const Vertex& b, const Vertex& c) {
  if (a.q == 0.0 || b.q == 0.0 || c.q == 0.0) return false;
  const auto [least, most] = std::minmax({a.depth, b.depth, c.depth});
  return most - least <= largest_step * static_cast<double>(least);
}

/// Twice the signed area of a triangle; positive where its corners run as in the depth image.
double cross(const Vertex& a, const Vertex& b, double u, double v) {
  return (b.u - a.u) * (v - a.v) - (b.v - a.v) * (u - a.u);
}

/// inverse: [1/m] the largest so far, of every pixel.
void draw(const Vertex& a, const Vertex& b, const Vertex& c, cv::Mat1d& inverse) {
  if (!of_one_surface(a, b, c)) return;
  const double area = cross(a, b, c.u, c.v);
  if (!(area > 0.0)) return;  // seen from behind
  const auto [left, right] = std::minmax({a.u, b.u, c.u});
  const auto [top, bottom] = std::minmax({a.v, b.v, c.v});
  if (!(right >= 0.0 && left <= inverse.cols - 1.0 && bottom >= 0.0 && top <= inverse.rows - 1.0)) return;
  const int x0 = static_cast<int>(std::ceil(std::max(0.0, left)));
  const int x1 = static_cast<int>(std::floor(std::min(inverse.cols - 1.0, right)));
  const int y0 = static_cast<int>(std::ceil(std::max(0.0, top)));
  const int y1 = static_cast<int>(std::floor(std::min(inverse.rows - 1.0, bottom)));
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) {
      const double wa = cross(b, c, x, y);
      const double wb = cross(c, a, x, y);
      const double wc = cross(a, b, x, y);
      if (wa < on_edge || wb < on_edge || wc < on_edge) continue;
      const double q = (wa * a.q + wb * b.q + wc * c.q) / area;
      inverse(y, x) = std::max(inverse(y, x), q);
    }
  }
}

}  // namespace

DepthImage registered_depth(const DepthImage& depth, const Camera& depth_camera, const SE3& T_color_depth,
                            const Camera& color_camera) {
  if (depth.cols != depth_camera.width || depth.rows != depth_camera.height) {
    throw InputError("depth", "is " + std::to_string(depth.cols) + "x" + std::to_string(depth.rows) +
                                  ", the depth camera " + std::to_string(depth_camera.width) + "x" +
                                  std::to_string(depth_camera.height));
  }
  const std::vector<Vertex> vertices = project(depth, depth_camera, T_color_depth, color_camera);
  cv::Mat1d inverse(color_camera.height, color_camera.width, 0.0);
  const auto row = static_cast<std::size_t>(depth.cols);
  for (int y = 0; y + 1 < depth.rows; ++y) {
    const Vertex* upper = vertices.data() + static_cast<std::size_t>(y) * row;
    const Vertex* lower = upper + row;
    for (int x = 0; x + 1 < depth.cols; ++x) {
      draw(upper[x], upper[x + 1], lower[x], inverse);
      draw(upper[x + 1], lower[x + 1], lower[x], inverse);
    }
  }
  DepthImage registered(inverse.size(), 0.0F);
  for (int y = 0; y < inverse.rows; ++y) {
    for (int x = 0; x < inverse.cols; ++x) {
      if (inverse(y, x) > 0.0) registered(y, x) = static_cast<float>(1.0 / inverse(y, x));
    }
  }
  return registered;
}

}  // namespace odosplat
