// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/sensor/lidar.hpp"

#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

constexpr float beam_width = 0.003F;  // [rad] width over which colour is averaged

}  // namespace

void LidarOptions::check() const {
  require(rings >= 1 && rings <= 4096, "lidar.rings", "in 1..4096");
  require(columns >= 1 && columns <= 16384, "lidar.columns", "in 1..16384");
  require(
      elevation_min >= -std::numbers::pi / 2 && elevation_max <= std::numbers::pi / 2 && elevation_min <= elevation_max,
      "lidar.elevation_min", "at most elevation_max, both in -pi/2..pi/2");
  require(range_min > 0.0 && range_max > range_min, "lidar.range_max", "above range_min, which must be positive");
  require(range_noise >= 0.0 && range_noise <= 0.5, "lidar.range_noise", "in 0..0.5");
  require(min_incidence >= 0.0 && min_incidence <= 1.0, "lidar.min_incidence", "in 0..1");
}

PointCloud simulate_lidar(const Scene& scene, const std::vector<SE3>& T_world_scanner, const LidarOptions& options) {
  options.check();
  PointCloud cloud;
  for (std::size_t scan = 0; scan < T_world_scanner.size(); ++scan) {
    const SE3& T = T_world_scanner[scan];
    require(T.is_finite(), "scanner pose", "finite");
    const Eigen::Matrix3d R = T.rotation_matrix();
    const Eigen::Vector3d& origin = T.translation();
    std::vector<PointCloud> rings(static_cast<std::size_t>(options.rings));
    parallel_for(options.rings, 1, [&](int begin, int end) {
      for (int ring = begin; ring < end; ++ring) {
        // Each ring has its own random stream, so that the points do not depend on which thread computes which ring.
        Random random(options.seed * 0x9E3779B97F4A7C15ULL + (static_cast<std::uint64_t>(scan) << 20) +
                      static_cast<std::uint64_t>(ring));
        PointCloud& out = rings[static_cast<std::size_t>(ring)];
        const double share = options.rings == 1 ? 0.5 : static_cast<double>(ring) / (options.rings - 1);
        const double elevation = options.elevation_min + share * (options.elevation_max - options.elevation_min);
        for (int column = 0; column < options.columns; ++column) {
          const double azimuth = 2.0 * std::numbers::pi * column / options.columns;
          const double noise = options.range_noise * random.normal();
          const Eigen::Vector3d direction =
              R * Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                                  std::sin(elevation));
          const Ray ray{origin.cast<float>(), direction.cast<float>()};
          RayHit hit;
          if (!scene.closest(ray, hit)) continue;
          const double range = scene.plane_parameter(hit.triangle, origin, direction);
          if (range < options.range_min || range > options.range_max) continue;
          const auto& triangle = scene.content().triangles[static_cast<std::size_t>(hit.triangle)];
          if (std::abs(triangle.normal_world.dot(ray.direction)) < options.min_incidence) continue;
          out.points.push_back((origin + (range + noise) * direction).cast<float>());
          if (options.colors) out.colors.push_back(scene.develop(scene.radiance(ray, hit, beam_width * hit.t)));
        }
      }
    });
    for (const PointCloud& ring : rings) {
      cloud.points.insert(cloud.points.end(), ring.points.begin(), ring.points.end());
      cloud.colors.insert(cloud.colors.end(), ring.colors.begin(), ring.colors.end());
    }
  }
  return cloud;
}

}  // namespace odosplat
