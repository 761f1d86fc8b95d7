// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>

#include "odosplat/compute/context.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// Gaussians in device memory: layouts and units as in Gaussians. The same struct holds gradients dL/d(attribute), each
/// attribute as it is stored (so with respect to log scales, logits and the quaternion as it is, not normalised).
/// Copies share memory, as Buffer does. Not thread safe.
struct DeviceGaussians {
  int sh_degree = 0;
  std::size_t count = 0;
  compute::Buffer<float> positions;       // [N x 3]
  compute::Buffer<float> log_scales;      // [N x 3]
  compute::Buffer<float> rotations;       // [N x 4]
  compute::Buffer<float> opacity_logits;  // [N]
  compute::Buffer<float> sh;              // [N x K x 3]

  std::size_t size() const { return count; }
  int coefficients() const { return sh_coefficients(sh_degree); }

  /// Sets the shape; contents are kept only where the buffers were large enough.
  void resize(const compute::Context& context, std::size_t n, int degree);
  /// Blocking. upload() takes over size and degree, and throws InputError as Gaussians::check does.
  void upload(const compute::Context& context, const Gaussians& gaussians);
  Gaussians download() const;
};

}  // namespace odosplat
