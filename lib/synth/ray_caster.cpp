// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/ray_caster.hpp"

#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/pixel_samples.hpp"

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
        const Eigen::Vector3f sum = pixel_radiance(scene, camera, R, centre_f, x, y, offsets, spacing, hint);
        const Eigen::Vector3f color = scene.develop(sum / static_cast<float>(options.samples));
        out.color(y, x) = {color.x(), color.y(), color.z()};
      }
    }
  });
  return out;
}

}  // namespace odosplat
