// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/trajectory.hpp"
#include "odosplat/synth/motion/moving_camera.hpp"
#include "odosplat/synth/scene/scene_description.hpp"
#include "odosplat/synth/sensor/kinect.hpp"
#include "odosplat/synth/sensor/sensors.hpp"

namespace odosplat::apps {

inline constexpr double synthetic_depth_units = 5000.0;  // a metre, as in TUM's files

/// What the camera is and does.
struct SyntheticCamera {
  Camera camera;
  ColorSensorOptions color;
  ShutterOptions shutter;
  bool kinect = false;  // false: true depth
  KinectOptions depth;
};

/// A sequence to be rendered.
struct SyntheticSequence {
  std::string folder;
  bool replace = false;  // true: images of other settings or of another origin in the folder are removed
  std::string what;      // text that tells everything the images depend on, but for their number
  Trajectory truth;      // poses of the frames, at equal times
  std::function<SE3(double time)> T_world_camera_at;
  SyntheticCamera camera;
};

/// Writes the sequence in TUM's layout: rgb/, depth/, rgb.txt, depth.txt, groundtruth.txt, camera.yaml. Frames that are
/// there already are kept if settings.txt says that they come from the same settings; if it says otherwise, they are
/// replaced or it is an InputError.
/// scene is called only if a frame is missing. The lists are written last: a folder that has them is whole. Throws
/// Interrupted between frames. Returns how many frames were rendered.
int write_synthetic_sequence(const SyntheticSequence& sequence, const std::function<const Scene&()>& scene);

/// The built-in scene of a name, or the description in a file (what has a dot or a slash in it).
SceneDescription open_scene(const std::string& scene);

}  // namespace odosplat::apps
