// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/accuracy/play.hpp"

#include <unistd.h>

#include <fstream>

#include "apps/command/interrupt.hpp"
#include "apps/command/support.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/progress.hpp"

namespace odosplat::accuracy {
namespace {

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  long total = 0;
  long resident = 0;
  file >> total >> resident;
  return static_cast<double>(resident) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

}  // namespace

Script in_order(const World& world, std::size_t begin, std::size_t end,
                const std::function<ImageEdit(std::size_t frame)>& edit) {
  Script script;
  for (std::size_t i = begin; i < end; ++i) {
    script.push_back({world.time(i), i, edit ? edit(i) : ImageEdit(), false});
  }
  return script;
}

Run play(const World& world, MapView& map, SensorView* sensor, const apps::TrackJob& job, const Script& script,
         const SE3& T_world_camera_start, const std::string& label, const Camera& told, const OptionEdit& edit) {
  Run run;
  run.frames.resize(script.size());  // allocated before the odometry, whose memory use is measured
  const Localiser localiser = make_localiser(told, map, sensor != nullptr, job, T_world_camera_start, edit);
  Odometry& odometry = *localiser.odometry;
  Progress progress(label, static_cast<long>(script.size()));
  double cpu = 0.0;
  double wall = 0.0;
  for (std::size_t k = 0; k < script.size(); ++k) {
    if (apps::interrupted()) throw Interrupted();
    const Step& step = script[k];
    if (sensor != nullptr) sensor->set_depth(world.depth(step.frame));
    GrayImage image = world.gray(step.frame);
    if (step.edit) image = step.edit(image);
    PlayedFrame& played = run.frames[k];
    played.time = step.time;
    played.frame = step.frame;
    played.blind = step.blind;
    played.T_world_camera_true = world.T_world_camera(step.frame);
    const double cpu_before = apps::cpu_seconds();
    const apps::Stopwatch watch;
    played.result = odometry.track(image, step.time);
    wall += watch.seconds();
    cpu += apps::cpu_seconds() - cpu_before;
    played.resident_mb = resident_mb();
    progress.update(static_cast<long>(k) + 1, to_string(played.result.status));
  }
  progress.finish();
  run.trajectory = odometry.trajectory();
  run.statistics = odometry.statistics();
  const double frames = static_cast<double>(std::max<std::size_t>(1, script.size()));
  run.cpu_ms = 1000.0 * cpu / 2.0 / frames;
  run.wall_ms = 1000.0 * wall / frames;
  return run;
}

Run play(const World& world, apps::OpenedView& opened, const apps::TrackJob& job, const Script& script,
         const std::string& label, const OptionEdit& edit) {
  return play(world, *opened.view, opened.sensor, job, script, world.T_world_camera(script.at(0).frame), label,
              world.camera(), edit);
}

Run play(const World& world, apps::OpenedView& opened, const apps::TrackJob& job, const Script& script,
         const std::string& label, const SE3& T_world_camera_start, const std::function<Camera(Camera)>& told) {
  return play(world, *opened.view, opened.sensor, job, script, T_world_camera_start, label, told(world.camera()));
}

}  // namespace odosplat::accuracy
