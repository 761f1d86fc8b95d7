// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>

#include "odosplat/synth/render/ray_caster.hpp"

namespace odosplat {

/// Motion blur and rolling shutter of a moving camera.
struct ShutterOptions {
  double shutter_s = 0.0;  // [s] exposure time, which causes motion blur; >= 0
  double readout_s = 0.0;  // [s] from the first row to the last (rolling shutter); >= 0
  int moments = 6;         // number of times within the exposure that are averaged, 1..64; 1 is used if shutter_s is 0

  /// Throws InputError naming the field.
  void check() const;
};

/// The image with the stamp `time` [s]: row y of a camera with H rows is exposed for shutter_s around
///   time + readout_s * (y / (H - 1) - 1/2).
/// Its colour is the mean in linear light over options.samples positions in the pixel and shutter.moments times. Depth
/// is that of a static camera at the pose of `time`, which is also the pose of the ground truth. Without blur and
/// readout the result is bit by bit that of render() at this pose. T_world_camera_at is called by several threads at
/// once. Deterministic, whatever the number of threads. Throws as render() does.
Rendering render_moving(const Scene& scene, const Camera& camera,
                        const std::function<SE3(double time)>& T_world_camera_at, double time,
                        const ShutterOptions& shutter, const RenderOptions& options = {});

}  // namespace odosplat
