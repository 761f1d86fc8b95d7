// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "odosplat/compute/program.hpp"

namespace odosplat {

struct AdamOptions {
  float beta1 = 0.9F;      // decay of the mean of gradients, 0..1
  float beta2 = 0.999F;    // decay of the mean of squared gradients, 0..1
  float epsilon = 1e-15F;  // added to the root of the second moment, > 0 (Kerbl et al. 2023)

  /// Throws InputError naming the field.
  void check() const;
};

/// Adam (Kingma and Ba 2015, algorithm 1) for one attribute: rows of `stride` floats, N of them, on the device. The
/// first `head` elements of a row move at the rate itself, the others at rate * rest_ratio (SH: colour and details).
/// Holds both moments and the number of steps made, all of which a checkpoint can take out and put back. Deterministic;
/// queued. Not thread safe.
class Adam {
 public:
  /// stride >= 1, 0 <= head <= stride, rest_ratio >= 0.
  Adam(const compute::Context& context, const AdamOptions& options, int stride, int head, float rest_ratio);

  /// parameters -= step; gradients of the same size. Moments start at zero whenever the size changes.
  void step(compute::Buffer<float>& parameters, const compute::Buffer<float>& gradients, double rate);
  /// Limits parameters to at most `bound`, element by element (same size). Queued.
  void limit(compute::Buffer<float>& parameters, const compute::Buffer<float>& bound);
  long steps() const { return steps_; }
  int stride() const { return stride_; }

  struct State {
    std::vector<float> first, second;  // both moments, as large as the parameters; empty before the first step
    long steps = 0;
  };
  State state() const;
  void set_state(const State& state);
  /// The parameters were rearranged in rows: row i has the moments of row from[i] before, or none (from[i] < 0).
  void rearrange(const std::vector<std::int64_t>& from);

 private:
  AdamOptions options_;
  compute::Context context_;
  compute::Program program_;
  compute::Kernel step_kernel_, limit_kernel_;
  int stride_;
  compute::Buffer<float> pattern_, first_, second_;
  long steps_ = 0;
};

}  // namespace odosplat
