// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/motion/moving_camera.hpp"

#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/render/pixel_samples.hpp"

namespace odosplat {

void ShutterOptions::check() const {
  require(shutter_s >= 0.0 && std::isfinite(shutter_s), "shutter.shutter_s", "not negative");
  require(readout_s >= 0.0 && std::isfinite(readout_s), "shutter.readout_s", "not negative");
  require(moments >= 1 && moments <= 64, "shutter.moments", "in 1..64");
}

Rendering render_moving(const Scene& scene, const Camera& camera,
                        const std::function<SE3(double time)>& T_world_camera_at, double time,
                        const ShutterOptions& shutter, const RenderOptions& options) {
  shutter.check();
  if (!options.color || (shutter.shutter_s == 0.0 && shutter.readout_s == 0.0)) {
    return render(scene, camera, T_world_camera_at(time), options);
  }
  RenderOptions depth_only = options;
  depth_only.color = false;
  Rendering out = render(scene, camera, T_world_camera_at(time), depth_only);
  out.color = ColorImage::zeros(camera.height, camera.width);
  const std::vector<Eigen::Vector2d> offsets = sample_offsets(options.samples);
  const float spacing = sample_spacing(camera, options.samples);
  const int moments = shutter.shutter_s > 0.0 ? shutter.moments : 1;
  constexpr int rows_a_chunk = 4;
  parallel_for(camera.height, rows_a_chunk, [&](int begin, int end) {
    std::vector<Eigen::Vector3f> row(static_cast<std::size_t>(camera.width));
    for (int y = begin; y < end; ++y) {
      for (Eigen::Vector3f& c : row) c.setZero();
      const double down = camera.height > 1 ? static_cast<double>(y) / (camera.height - 1) - 0.5 : 0.0;
      for (int m = 0; m < moments; ++m) {
        const double within = shutter.shutter_s * ((m + 0.5) / moments - 0.5);
        const SE3 T_world_camera = T_world_camera_at(time + shutter.readout_s * down + within);
        const Eigen::Matrix3d R = T_world_camera.rotation_matrix();
        const Eigen::Vector3f centre = T_world_camera.translation().cast<float>();
        int hint = -1;
        for (int x = 0; x < camera.width; ++x) {
          row[static_cast<std::size_t>(x)] += pixel_radiance(scene, camera, R, centre, x, y, offsets, spacing, hint);
        }
      }
      for (int x = 0; x < camera.width; ++x) {
        const Eigen::Vector3f color =
            scene.develop(row[static_cast<std::size_t>(x)] / static_cast<float>(moments * options.samples));
        out.color(y, x) = {color.x(), color.y(), color.z()};
      }
    }
  });
  return out;
}

}  // namespace odosplat
