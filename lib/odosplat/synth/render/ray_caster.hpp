// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/synth/scene/scene.hpp"

namespace odosplat {

struct RenderOptions {
  int samples = 4;    // colour samples per pixel, in 1..64
  bool color = true;  // false: only depth, about five times as fast

  /// Throws InputError naming the field.
  void check() const;
};

struct Rendering {
  ColorImage color;  // [H x W] stored colour 0..1; empty if not requested
  DepthImage depth;  // [H x W] z [m] along the optical axis at the pixel's centre; 0 where nothing is hit
};

/// An image of the scene. Depth is that of the triangle at the pixel's centre, rounded to float. Colour is the mean in
/// linear light of `samples` rays at fixed positions in the pixel (Roberts' R2 sequence), a box filter one pixel wide;
/// with 1 sample it is the colour at the centre. Deterministic, whatever the number of threads. Reentrant. Throws
/// InputError for a camera or options that are not valid.
Rendering render(const Scene& scene, const Camera& camera, const SE3& T_world_camera,
                 const RenderOptions& options = {});

}  // namespace odosplat
