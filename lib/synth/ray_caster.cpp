// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/ray_caster.hpp"

#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

constexpr int rows_a_chunk = 8;

/// Offsets from the pixel's centre [px]; their mean is the centre.
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

}  // namespace

void RenderOptions::check() const { require(samples >= 1 && samples <= 64, "render.samples", "in 1..64"); }

Rendering render(const Scene& scene, const Camera& camera, const SE3& T_world_camera, const RenderOptions& options) {
  camera.check();
  options.check();
  require(T_world_camera.is_finite(), "camera pose", "finite");
  Rendering out;
  out.depth = DepthImage::zeros(camera.height, camera.width);
  if (options.color) out.color = ColorImage::zeros(camera.height, camera.width);
  const std::vector<Eigen::Vector2d> offsets = sample_offsets(options.samples);
  const Eigen::Matrix3d R = T_world_camera.rotation_matrix();
  const Eigen::Vector3d& centre = T_world_camera.translation();
  const Eigen::Vector3f centre_f = centre.cast<float>();
  // A little more than the samples' distance, so that what lies between them is seen too.
  const double spacing = 1.2 / (std::sqrt(static_cast<double>(options.samples)) * camera.fx);

  parallel_for(camera.height, rows_a_chunk, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      int hint = -1;
      for (int x = 0; x < camera.width; ++x) {
        RayHit hit;
        // The direction has z = 1 in the camera, so the ray parameter is the depth.
        const Eigen::Vector3d direction = R * camera.ray(x, y);
        if (scene.closest({centre_f, direction.cast<float>()}, hit, hint)) {
          out.depth(y, x) = static_cast<float>(scene.plane_parameter(hit.triangle, centre, direction));
          hint = hit.triangle;
        } else {
          hint = -1;
        }
        if (!options.color) continue;
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (const Eigen::Vector2d& o : offsets) {
          const Ray ray{centre_f, (R * camera.ray(x + o.x(), y + o.y())).cast<float>()};
          if (scene.closest(ray, hit, hint)) {
            sum += scene.radiance(ray, hit, hit.t * static_cast<float>(spacing));
            hint = hit.triangle;
          } else {
            sum += scene.background(ray.direction);
          }
        }
        const Eigen::Vector3f color = scene.develop(sum / static_cast<float>(options.samples));
        out.color(y, x) = {color.x(), color.y(), color.z()};
      }
    }
  });
  return out;
}

}  // namespace odosplat
