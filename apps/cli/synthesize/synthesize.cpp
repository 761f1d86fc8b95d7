// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <CLI/CLI.hpp>
#include <memory>
#include <optional>

#include "apps/cli/synthesize/synthesize_sequence.hpp"
#include "apps/command/number_flags.hpp"
#include "apps/command/output.hpp"
#include "apps/command/support.hpp"
#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/synth/motion/clearance.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/sensor/lidar.hpp"

namespace odosplat::apps {
namespace {

constexpr double focal_share = 0.75;      // focal length / width, as of ICL-NUIM's camera
constexpr double least_clearance = 0.15;  // [m] a camera nearer to a surface would be inside the furniture

struct SynthesizeFlags {
  bool list = false;
  std::string scene;
  std::string walk;
  std::string out;
  std::string cloud;
  std::string size = "320x240";
  int frames = 0;
  std::uint64_t seed = 1;
  double voxel = 0.03;
  std::optional<double> noise, exposure_swing, shutter_ms, readout_ms;
  bool kinect = false;
};

void print_list() {
  for (const std::string& name : built_in_scenes()) {
    const SceneDescription scene = built_in_scene(name);
    print("%s: %.1f x %.1f x %.1f m\n", name.c_str(), static_cast<double>(scene.size.x()),
          static_cast<double>(scene.size.y()), static_cast<double>(scene.size.z()));
    for (const WalkDescription& walk : scene.walks) {
      print("  %-10s %5d frames  %6.2f s  %6.2f m\n", walk.name.c_str(), walk.options.frames,
            walk.options.frames / walk.options.fps, walk.options.length_m);
    }
  }
}

SyntheticCamera camera_of(const SynthesizeFlags& flags, const SensorCharacter& character) {
  SyntheticCamera camera;
  const Size size = parse_size("--size", flags.size);
  const double focal = focal_share * size.width;
  camera.camera = {size.width, size.height, focal, focal, 0.5 * size.width - 0.5, 0.5 * size.height - 0.5};
  camera.color.read_noise = flags.noise.value_or(character.noise);
  if (camera.color.read_noise == 0.0) camera.color.shot_noise = 0.0;
  camera.color.exposure_swing = flags.exposure_swing.value_or(character.exposure_swing);
  camera.shutter.shutter_s = 1e-3 * flags.shutter_ms.value_or(character.shutter_ms);
  camera.shutter.readout_s = 1e-3 * flags.readout_ms.value_or(character.readout_ms);
  camera.kinect = flags.kinect;
  camera.color.seed = camera.depth.seed = flags.seed;
  camera.camera.check();
  camera.color.check();
  camera.shutter.check();
  return camera;
}

/// All settings that the frames depend on.
std::string settings_text(const SynthesizeFlags& flags, const SyntheticCamera& camera) {
  const bool built_in = flags.scene.find_first_of("./") == std::string::npos;
  return formatted(
             "odosplat %s\nwalk %s\nsize %s\nseed %llu\nnoise %.9g\nexposure_swing %.9g\nshutter_s %.9g\n"
             "readout_s %.9g\nkinect %d\nscene:\n",
             ODOSPLAT_VERSION, flags.walk.c_str(), flags.size.c_str(), static_cast<unsigned long long>(flags.seed),
             camera.color.read_noise, camera.color.exposure_swing, camera.shutter.shutter_s, camera.shutter.readout_s,
             camera.kinect ? 1 : 0) +
         (built_in ? std::string(built_in_scene_text(flags.scene)) : read_file(flags.scene));
}

void write_sequence(const SynthesizeFlags& flags, const SceneDescription& description,
                    const std::function<const Scene&()>& scene) {
  const Stopwatch watch;
  const WalkDescription& chosen = description.walk(flags.walk);
  const Walk walk(chosen.waypoints, chosen.options);
  SyntheticSequence sequence;
  sequence.folder = flags.out;
  sequence.camera = camera_of(flags, chosen.sensor);
  sequence.what = settings_text(flags, sequence.camera);
  sequence.truth = walk.trajectory();
  sequence.T_world_camera_at = [&walk](double time) { return walk.pose_at(time); };
  const Trajectory whole = sequence.truth;
  if (flags.frames > 0) {
    if (static_cast<std::size_t>(flags.frames) > whole.size()) {
      throw InputError("--frames", "the walk has " + std::to_string(whole.size()));
    }
    sequence.truth.resize(static_cast<std::size_t>(flags.frames));
  }
  auto checked_scene = [&]() -> const Scene& {
    const Scene& world = scene();
    const Clearance nearest = clearance(world, whole);
    if (nearest.distance < least_clearance) {
      const Eigen::Vector3d& eye = whole[nearest.frame].T_world_camera.translation();
      throw InputError(description.name, "walk " + flags.walk,
                       formatted("comes to %.2f m of something at frame %zu, (%.2f, %.2f, %.2f): needs %.2f m",
                                 nearest.distance, nearest.frame, eye.x(), eye.y(), eye.z(), least_clearance));
    }
    return world;
  };
  const int rendered = write_synthetic_sequence(sequence, checked_scene);
  print("%s: %zu frames, %.2f m, %d rendered in %.1f s\n", flags.out.c_str(), sequence.truth.size(),
        travelled_length(sequence.truth), rendered, watch.seconds());
}

void write_cloud(const SynthesizeFlags& flags, const SceneDescription& description, const Scene& scene) {
  LidarOptions lidar;
  lidar.seed = flags.seed;
  const std::vector<SE3> places = scan_poses(description);
  if (places.empty()) throw InputError(description.name, "lidar", "has no places to scan from");
  log_info("scanning " + description.name + " from " + std::to_string(places.size()) + " places");
  const PointCloud cloud = voxel_downsample(simulate_lidar(scene, places, lidar), flags.voxel);
  write_point_cloud(flags.cloud, cloud);
  print("%s: %zu points from %zu scans\n", flags.cloud.c_str(), cloud.size(), places.size());
}

void run(const SynthesizeFlags& flags) {
  if (flags.list) return print_list();
  if (flags.scene.empty()) throw InputError("--scene", "is needed (--list tells which there are)");
  if (flags.out.empty() && flags.cloud.empty()) throw InputError("--out or --cloud", "is needed");
  if (!flags.out.empty() && flags.walk.empty()) throw InputError("--walk", "is needed with --out");
  const SceneDescription description = open_scene(flags.scene);
  if (!flags.cloud.empty()) check_extension(flags.cloud, {".ply"});
  const MadeFolders made_folders = ensure_output_if_given(flags.cloud);
  std::optional<Scene> made;
  auto scene = [&]() -> const Scene& {
    if (!made) made.emplace(make_scene(description, flags.seed));
    return *made;
  };
  if (!flags.out.empty()) write_sequence(flags, description, scene);
  if (!flags.cloud.empty()) write_cloud(flags, description, scene());
}

}  // namespace

void add_synthesize(CLI::App& app, Common& common) {
  CLI::App* command = add_command(app, common, "synthesize",
                                  "render a synthetic room: sequences with true depth and poses, a scanner's cloud");
  auto flags = std::make_shared<SynthesizeFlags>();
  command->add_flag("--list", flags->list, "print the scenes and their walks");
  command->add_option("--scene", flags->scene, "a scene of --list, or a description (FILE.yaml)");
  command->add_option("--walk", flags->walk, "a walk of the scene");
  command->add_option("--out", flags->out, "folder for the sequence; frames that are there are kept");
  command->add_option("--cloud", flags->cloud, "PLY file for what a lidar sees of the scene");
  command->add_option("--size", flags->size, "WIDTHxHEIGHT of the images [px]");
  add_number(command, "--frames", flags->frames, {.least = 0, .word = "all"},
             "render only the first N frames; 0 or all: all of them");
  add_number(command, "--seed", flags->seed, {}, "seed of textures and noise");
  add_number(command, "--voxel", flags->voxel, {.least = 0.0, .most = 1000.0, .least_excluded = true},
             "edge of the cloud's voxels, a point each [m]");
  const char* of_walk = "walk";  // default: the value in the walk's description
  add_number(command, "--noise", flags->noise, {.least = 0.0, .most = 0.5, .word = of_walk},
             "standard deviation of colours, which are 0 to 1; walk: as the walk has it");
  add_number(command, "--exposure-swing", flags->exposure_swing, {.least = 0.0, .most = 0.9, .word = of_walk},
             "share of the gain by which auto exposure changes it");
  const Bounds<double> milliseconds{.least = 0.0, .most = 1000.0, .word = of_walk};
  add_number(command, "--shutter-ms", flags->shutter_ms, milliseconds, "shutter time: motion blur [ms]");
  add_number(command, "--readout-ms", flags->readout_ms, milliseconds,
             "time from the first row to the last: rolling shutter [ms]");
  command->add_flag("--kinect", flags->kinect, "depth as a Kinect measures it; else true depth");
  command->final_callback([flags] { run(*flags); });
}

}  // namespace odosplat::apps
