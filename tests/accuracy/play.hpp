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

/// One image passed to the odometry.
struct Step {
  double time = 0.0;      // [s] time stamp passed to the odometry; strictly ascending
  std::size_t frame = 0;  // of the world: source of the image and of the true pose
  ImageEdit edit = {};    // applied to the frame's image; empty: none
  bool blind = false;     // the image shows nothing of the world, so there is no correct pose
};
using Script = std::vector<Step>;

/// Frames begin to end - 1 in order, at their own times, each with the edit if given.
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

/// Result of playing a script.
struct Run {
  std::vector<PlayedFrame> frames;  // one per step
  Trajectory trajectory;            // the odometry's final estimate
  OdometryStatistics statistics;
  double cpu_ms = 0.0;   // CPU time of all threads per frame divided by two, odometry only, mean over frames
  double wall_ms = 0.0;  // wall time per frame, odometry only, mean over frames
};

/// Plays a script to a new odometry. sensor: receives each frame's depth image for method rgbd, null for other methods.
/// label: for progress lines. told: camera model that the odometry is given. edit: changes the odometry's options.
/// Throws Interrupted after Ctrl-C.
Run play(const World& world, MapView& map, SensorView* sensor, const apps::TrackJob& job, const Script& script,
         const SE3& T_world_camera_start, const std::string& label, const Camera& told, const OptionEdit& edit = {});

/// The same in the world's map; `told` computes the camera model for the odometry from the world's.
Run play(const World& world, apps::OpenedView& opened, const apps::TrackJob& job, const Script& script,
         const std::string& label, const SE3& T_world_camera_start, const std::function<Camera(Camera)>& told);

/// The same in the world's map, with the true camera model and the true pose of the first step as start.
Run play(const World& world, apps::OpenedView& opened, const apps::TrackJob& job, const Script& script,
         const std::string& label, const OptionEdit& edit = {});

}  // namespace odosplat::accuracy
