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

/// Reference for the speed of the rasteriser's depth: the same algorithm (projection, exact tile test, radix sort by
/// depth, binning, front-to-back compositing by blocks of 4 x 4 pixels with the same rules for alpha) without OpenCL,
/// in AVX2 intrinsics on two threads. Only expected depth with ray planes and uncompensated opacity.
/// Result: depth() [H x W] m as RenderOutput::depth. Deterministic. One render at a time.
class Yardstick {
 public:
  /// False if the CPU is not x86-64 or lacks AVX2 or FMA: then the class must not be constructed.
  static bool supported();

  static constexpr int threads = 2;
  struct Stages {
    double project_ms = 0.0, sort_ms = 0.0, bin_ms = 0.0, composite_ms = 0.0;  // wall time
  };

  Yardstick(const Gaussians& gaussians, const Camera& camera, const SE3& T_world_camera);
  ~Yardstick();
  Yardstick(const Yardstick&) = delete;
  Yardstick& operator=(const Yardstick&) = delete;

  void render();
  const std::vector<float>& depth() const;
  std::size_t pairs() const;
  /// Times of the last render.
  Stages stages() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace odosplat
