// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/pixel_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace odosplat {

std::vector<Eigen::Vector2d> sample_offsets(int n) {
  std::vector<Eigen::Vector2d> offsets;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (int i = 0; i < n; ++i) {
    const double x = 0.7548776662466927 * (i + 1);
    const double y = 0.5698402909980532 * (i + 1);
    offsets.emplace_back(x - std::floor(x), y - std::floor(y));
    mean += offsets.back() / n;
  }
  for (Eigen::Vector2d& o : offsets) o -= mean;
  return offsets;
}

float sample_spacing(const Camera& camera, int n) {
  return static_cast<float>(1.2 / (std::sqrt(static_cast<double>(n)) * camera.fx));
}

Eigen::Vector3f pixel_radiance(const Scene& scene, const Camera& camera, const Eigen::Matrix3d& R_world_camera,
                               const Eigen::Vector3f& centre_world, int x, int y,
                               const std::vector<Eigen::Vector2d>& offsets, float spacing, int& hint) {
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  const std::size_t n = offsets.size();
  for (std::size_t first = 0; first < n; first += 4) {
    std::array<Ray, 4> rays;
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d& o = offsets[std::min(first + i, n - 1)];
      rays[i] = {centre_world, (R_world_camera * camera.ray(x + o.x(), y + o.y())).cast<float>()};
    }
    std::array<RayHit, 4> hits;
    std::array<bool, 4> found{};
    scene.closest4(rays, hits, found, hint);
    hint = found[0] ? hits[0].triangle : -1;
    for (std::size_t i = 0; i < std::min<std::size_t>(4, n - first); ++i) {
      sum += found[i] ? scene.radiance(rays[i], hits[i], hits[i].t * spacing) : scene.background(rays[i].direction);
    }
  }
  return sum;
}

}  // namespace odosplat
