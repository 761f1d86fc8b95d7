// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/render/ray_caster.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/render/pixel_samples.hpp"

namespace odosplat {
namespace {

constexpr int rows_a_chunk = 8;

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
  const float spacing = sample_spacing(camera, options.samples);

  parallel_for(camera.height, rows_a_chunk, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      int hint = -1;
      for (int x0 = 0; x0 < camera.width; x0 += 4) {
        // The direction has z = 1 in the camera, so the ray parameter is the depth.
        std::array<Ray, 4> rays;
        std::array<Eigen::Vector3d, 4> directions;
        for (int i = 0; i < 4; ++i) {
          const auto k = static_cast<std::size_t>(i);
          directions[k] = R * camera.ray(std::min(x0 + i, camera.width - 1), y);
          rays[k] = {centre_f, directions[k].cast<float>()};
        }
        std::array<RayHit, 4> hits;
        std::array<bool, 4> found{};
        scene.closest4(rays, hits, found, hint);
        hint = found[3] ? hits[3].triangle : -1;
        for (int x = x0; x < std::min(x0 + 4, camera.width); ++x) {
          const auto k = static_cast<std::size_t>(x - x0);
          if (!found[k]) continue;
          out.depth(y, x) = static_cast<float>(scene.plane_parameter(hits[k].triangle, centre, directions[k]));
        }
      }
      if (!options.color) continue;
      hint = -1;
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector3f sum = pixel_radiance(scene, camera, R, centre_f, x, y, offsets, spacing, hint);
        const Eigen::Vector3f color = scene.develop(sum / static_cast<float>(options.samples));
        out.color(y, x) = {color.x(), color.y(), color.z()};
      }
    }
  });
  return out;
}

}  // namespace odosplat
