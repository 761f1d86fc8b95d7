// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/compute/program.hpp"

namespace odosplat {

struct DepthLossOptions {
  double weight = 2.0;  // of the term beside the image loss, >= 0; 0: no depth term
  double cut = 0.05;    // relative difference beyond which the target counts as another surface, and the gradient is 0,
                        // > 0.001

  /// Throws InputError naming the field.
  void check() const;
};

/// weight * mean over all pixels of w rho((rendered - target) / target), on the device; rho: absolute value, smooth
/// below 0.001 and constant beyond `cut`; pixels without rendered or target depth count as 0.
/// Source: the depth term of MonoGS (Matsuki et al. 2024, eq. 9), here relative to depth and cut. Queued; the same bits
/// on one device. Not thread safe.
class DepthLoss {
 public:
  DepthLoss(const compute::Context& context, const DepthLossOptions& options);

  /// rendered, target [height x width] m, 0 = none; pixel_weight [height x width] 0..1. Writes dloss/drendered
  /// (resized).
  void evaluate(const compute::Buffer<float>& rendered, const compute::Buffer<float>& target,
                const compute::Buffer<float>& pixel_weight, int width, int height, compute::Buffer<float>& gradient);
  /// Weighted mean of rho over the pixels with both depths at the last evaluate(); 0 where there were none. Waits.
  double mean_relative_error() const;

 private:
  DepthLossOptions options_;
  compute::Context context_;
  compute::Kernel kernel_;
  compute::Buffer<float> rows_;
};

}  // namespace odosplat
