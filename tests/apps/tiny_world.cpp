// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/apps/tiny_world.hpp"

#include <cstdio>

#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/render/ray_caster.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat::apps_test {

void write_tiny_sequence(const std::filesystem::path& folder, int frames) {
  CameraFile camera;
  camera.camera = {160, 120, 130.0, 130.0, 79.5, 59.5};
  camera.depth_scale = 5000.0;
  const Scene scene = make_box_room(7);
  PathOptions path;
  path.frames = frames;
  path.tremor_m = 0.001;
  path.tremor_rad = 0.002;
  const Trajectory truth = hand_held_path(
      {{{1.2, 1.0, 1.3}, {3.6, 2.0, 1.0}}, {{1.5, 1.2, 1.3}, {3.5, 1.8, 1.0}}, {{1.7, 1.1, 1.4}, {3.5, 1.5, 1.0}}},
      path);
  std::string rgb = "# color images\n";
  std::string depth = "# depth maps\n";
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const Rendering image = render(scene, camera.camera, truth[i].T_world_camera);
    char name[32];
    std::snprintf(name, sizeof(name), "/%04zu.png", i);
    write_color((folder / "rgb").string() + name, image.color);
    write_depth((folder / "depth").string() + name, image.depth, camera.depth_scale);
    rgb += truth[i].stamp() + " rgb" + name + "\n";
    depth += truth[i].stamp() + " depth" + name + "\n";
  }
  write_file_atomically(folder / "rgb.txt", rgb);
  write_file_atomically(folder / "depth.txt", depth);
  write_trajectory(folder / "groundtruth.txt", truth);
  write_camera_file(folder / "camera.yaml", camera);
}

}  // namespace odosplat::apps_test
