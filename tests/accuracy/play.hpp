// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "tests/accuracy/world.hpp"

namespace odosplat::accuracy {

using ImageEdit = std::function<GrayImage(const GrayImage&)>;

/// One image that is played to the odometry.
struct Step {
  double time = 0.0;      // [s] that the odometry is told; strictly ascending
  std::size_t frame = 0;  // of the world: where the image is from and what the pose is judged by
  ImageEdit edit = {};    // makes the image that is played from the frame's; empty: the image as it is
  bool blind = false;     // the image shows nothing of the world: no pose can be right but by chance
};
using Script = std::vector<Step>;

/// Frames begin to end - 1 in order, at their own times, each through the edit if there is one.
Script in_order(const World& world, std::size_t begin, std::size_t end,
                const std::function<ImageEdit(std::size_t frame)>& edit = {});

struct PlayedFrame {
  double time = 0.0;
  std::size_t frame = 0;
  bool blind = false;
  TrackResult result;
  SE3 T_world_camera_true;
  double resident_mb = 0.0;  // of this process, after the frame
};

/// What came of a script.
struct Run {
  std::vector<PlayedFrame> frames;  // a step each
  Trajectory trajectory;            // the odometry's final estimate
  OdometryStatistics statistics;
  double cpu_ms = 0.0;   // CPU seconds of all threads a frame, divided by two, odometry alone: mean over frames
  double wall_ms = 0.0;  // the same by the clock on the wall
};

/// Plays a script to a new odometry. rgbd: the sensor that shows each frame's depth, null for other methods.
/// label: for progress lines. told: the camera that the odometry is told of. edit: changes its options. Interrupted
/// after Ctrl-C.
Run play(const World& world, MapView& map, SensorView* sensor, const apps::TrackJob& job, const Script& script,
         const SE3& T_world_camera_start, const std::string& label, const Camera& told, const OptionEdit& edit = {});

/// The same in the world's map, with the camera that the odometry is told of made from the world's.
Run play(const World& world, apps::OpenedView& opened, const apps::TrackJob& job, const Script& script,
         const std::string& label, const SE3& T_world_camera_start, const std::function<Camera(Camera)>& told);

/// The same in the world's map, from the true pose of the first step.
Run play(const World& world, apps::OpenedView& opened, const apps::TrackJob& job, const Script& script,
         const std::string& label, const OptionEdit& edit = {});

}  // namespace odosplat::accuracy
