// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "demo_world.hpp"

#include <cstdio>

#include "odosplat/core/error.hpp"
#include "odosplat/core/progress.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/camera_file.hpp"
#include "odosplat/io/cloud_file.hpp"
#include "odosplat/io/image_file.hpp"
#include "odosplat/io/trajectory_file.hpp"
#include "odosplat/map/cloud_filters.hpp"
#include "odosplat/synth/lidar.hpp"
#include "odosplat/synth/path.hpp"
#include "odosplat/synth/ray_caster.hpp"
#include "odosplat/synth/rooms.hpp"
#include "odosplat/synth/sensors.hpp"
#include "support.hpp"

namespace odosplat::apps {
namespace {

constexpr double depth_units = 5000.0;  // a metre, as in TUM's files
constexpr double cloud_voxel = 0.04;    // [m]

Trajectory walk(const DemoOptions& options) {
  PathOptions path;
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

void write_images(const Scene& scene, const DemoWorld& world, const DemoOptions& options) {
  ColorSensorOptions sensor;
  sensor.seed = options.seed;
  std::string rgb = "# time file\n";
  std::string depth = "# time file\n";
  Progress progress("render room", static_cast<long>(world.truth.size()));
  for (std::size_t i = 0; i < world.truth.size(); ++i) {
    if (interrupted()) throw Interrupted();
    const Rendering image = render(scene, world.camera, world.truth[i].T_world_camera);
    const ColorImage seen = sense_color(image.color, sensor, static_cast<int>(i), world.truth[i].time);
    char name[32];
    std::snprintf(name, sizeof(name), "/%06zu.png", i);
    write_color(world.sequence + "/rgb" + name, seen);
    write_depth(world.sequence + "/depth" + name, image.depth, depth_units);
    rgb += world.truth[i].stamp() + " rgb" + name + "\n";
    depth += world.truth[i].stamp() + " depth" + name + "\n";
    progress.update(static_cast<long>(i) + 1);
  }
  write_file_atomically(world.sequence + "/rgb.txt", rgb);
  write_file_atomically(world.sequence + "/depth.txt", depth);
}

}  // namespace

DemoWorld make_demo_world(const std::string& out, const DemoOptions& options) {
  DemoWorld world;
  world.sequence = out + "/sequence";
  world.cloud = out + "/cloud.ply";
  const double focal = 0.78125 * options.width;  // 65 degrees across
  world.camera = {options.width, options.height, focal, focal, 0.5 * options.width - 0.5, 0.5 * options.height - 0.5};
  world.camera.check();
  world.truth = walk(options);
  const Scene scene = make_living_room(options.seed);
  write_images(scene, world, options);
  write_trajectory(world.sequence + "/groundtruth.txt", world.truth);
  CameraFile file;
  file.camera = world.camera;
  file.depth_scale = depth_units;
  file.fps = 30.0;
  write_camera_file(world.sequence + "/camera.yaml", file);
  write_point_cloud(world.cloud, scan(scene, options));
  return world;
}

}  // namespace odosplat::apps
