// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>

#include "odosplat/synth/render/ray_caster.hpp"

namespace odosplat {

/// A shutter that takes time, on a camera that moves.
struct ShutterOptions {
  double shutter_s = 0.0;  // [s] open for so long: motion blur; >= 0
  double readout_s = 0.0;  // [s] from the first row to the last: rolling shutter; >= 0
  int moments = 6;         // of the open shutter that are averaged, 1..64; 1 is taken if shutter_s is 0

  /// Throws InputError naming the field.
  void check() const;
};

/// The image that is stamped `time` [s]: row y of a camera with H rows is exposed around time + readout_s * (y / (H -
/// 1) - 1/2), for shutter_s; its colour is the mean in linear light over options.samples places and shutter.moments
/// moments. Depth is what a still camera would see from the pose at `time`, the one that the truth gives. With neither
/// blur nor readout this is render() of that pose, bit for bit. T_world_camera_at is asked by several threads at once.
/// Deterministic whatever their number. Throws as render() does.
Rendering render_moving(const Scene& scene, const Camera& camera,
                        const std::function<SE3(double time)>& T_world_camera_at, double time,
                        const ShutterOptions& shutter, const RenderOptions& options = {});

}  // namespace odosplat
