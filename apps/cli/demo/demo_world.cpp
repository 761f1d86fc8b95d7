// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/demo/demo_world.hpp"

#include <cmath>

#include "apps/cli/synthesize/synthesize_sequence.hpp"
#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/synth/motion/path.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/sensor/lidar.hpp"

namespace odosplat::apps {
namespace {

constexpr double demo_fps = 30.0;
constexpr double cloud_voxel = 0.04;  // [m]

Trajectory walk(const DemoOptions& options) {
  PathOptions path;
  path.fps = demo_fps;
  path.frames = options.frames;
  path.seed = options.seed;
  return hand_held_path(living_room_walk(), path);
}

PointCloud scan(const Scene& scene, const DemoOptions& options) {
  LidarOptions lidar;
  lidar.seed = options.seed;
  const PointCloud cloud = simulate_lidar(scene, living_room_scan_poses(), lidar);
  return voxel_downsample(cloud, cloud_voxel);
}

}  // namespace

DemoWorld make_demo_world(const std::string& out, const DemoOptions& options) {
  DemoWorld world;
  world.sequence = out + "/sequence";
  world.cloud = out + "/cloud.ply";
  const double focal = 0.78125 * options.width;  // horizontal field of view of 65 degrees
  world.camera = {options.width, options.height, focal, focal, 0.5 * options.width - 0.5, 0.5 * options.height - 0.5};
  world.camera.check();
  world.truth = walk(options);
  const Scene scene = make_living_room(options.seed);
  SyntheticSequence sequence;
  sequence.folder = world.sequence;
  sequence.replace = true;
  sequence.what = "demo " + std::to_string(options.width) + "x" + std::to_string(options.height) + " frames " +
                  std::to_string(options.frames) + " seed " + std::to_string(options.seed) + " odosplat " +
                  ODOSPLAT_VERSION + "\n" + std::string(built_in_scene_text("living_room"));
  sequence.truth = world.truth;
  sequence.T_world_camera_at = [&](double time) {
    return world.truth[static_cast<std::size_t>(std::lround(time * demo_fps))].T_world_camera;
  };
  sequence.camera.camera = world.camera;
  sequence.camera.color.seed = options.seed;
  write_synthetic_sequence(sequence, [&]() -> const Scene& { return scene; });
  write_point_cloud(world.cloud, scan(scene, options));
  return world;
}

}  // namespace odosplat::apps
