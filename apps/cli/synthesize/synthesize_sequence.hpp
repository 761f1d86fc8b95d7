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

inline constexpr double synthetic_depth_units = 5000.0;  // per metre, as in TUM's files

/// The camera and its sensor effects.
struct SyntheticCamera {
  Camera camera;
  ColorSensorOptions color;
  ShutterOptions shutter;
  bool kinect = false;  // false: depth without noise
  KinectOptions depth;
};

/// A sequence to be rendered.
struct SyntheticSequence {
  std::string folder;
  bool replace = false;  // true: images in the folder that have other settings or are not from this program are removed
  std::string what;      // text with everything that the images depend on, except their number
  Trajectory truth;      // poses of the frames, at equal time steps
  std::function<SE3(double time)> T_world_camera_at;
  SyntheticCamera camera;
};

/// Writes the sequence in TUM's layout: rgb/, depth/, rgb.txt, depth.txt, groundtruth.txt, camera.yaml. Existing frames
/// are kept if settings.txt contains the same settings. If it contains others, they are replaced (with `replace`) or it
/// is an InputError.
/// scene is called only if a frame is missing. The lists are written last: a folder with lists is complete. Throws
/// Interrupted between frames. Returns the number of frames rendered.
int write_synthetic_sequence(const SyntheticSequence& sequence, const std::function<const Scene&()>& scene);

/// The built-in scene of this name, or the description in a file (a name with a dot or a slash).
SceneDescription open_scene(const std::string& scene);

}  // namespace odosplat::apps
