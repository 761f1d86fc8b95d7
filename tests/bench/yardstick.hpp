// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// What the rasteriser's depth is held against: the same algorithm (projection, exact tile test, radix sort by depth,
/// binning, front-to-back compositing by blocks of 4 x 4 pixels with the same rules for alpha) without OpenCL, in AVX2
/// intrinsics on two threads. Expected depth with ray planes, opacity not compensated; nothing else.
/// Result: depth() [H x W] m as RenderOutput::depth. Deterministic. One render at a time.
class Yardstick {
 public:
  /// False where the CPU lacks AVX2 or FMA, or is none of the x86-64 family: do not construct one then.
  static bool supported();

  static constexpr int threads = 2;
  struct Stages {
    double project_ms = 0.0, sort_ms = 0.0, bin_ms = 0.0, composite_ms = 0.0;  // wall
  };

  Yardstick(const Gaussians& gaussians, const Camera& camera, const SE3& T_world_camera);
  ~Yardstick();
  Yardstick(const Yardstick&) = delete;
  Yardstick& operator=(const Yardstick&) = delete;

  void render();
  const std::vector<float>& depth() const;
  std::size_t pairs() const;
  /// Of the last render.
  Stages stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace odosplat
