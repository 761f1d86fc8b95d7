// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "odosplat/compute/program.hpp"

namespace odosplat::compute {

/// How Scan and RadixSort lay out their work; results are equal on every device.
enum class Layout {
  automatic,  // chunks on CPUs, groups elsewhere
  chunks,     // few long chunks, one work-item per chunk
  groups      // many work-groups of SCAN_GROUP items with local memory
};

/// The layout to use: `wanted`, with `automatic` resolved for the context's device.
Layout chosen_layout(Layout wanted, const Context& context);

/// Exclusive prefix sum of 32-bit counts. Integer sums: the same result on every device.
class Scan {
 public:
  explicit Scan(const Context& context, Layout layout = Layout::automatic);

  /// out[i] = counts[0] + ... + counts[i-1] for i in 0..n (n + 1 values, the last is the total); out is resized.
  /// `counts` has at least n elements. Sums beyond 2^32 - 1 wrap around. Queued, not waited for.
  void exclusive(const Buffer<std::uint32_t>& counts, std::size_t n, Buffer<std::uint32_t>& out);

 private:
  Context context_;
  bool groups_;
  Program program_;
  Kernel sums_kernel_, starts_kernel_, write_kernel_;
  Buffer<std::uint32_t> sums_;
};

}  // namespace odosplat::compute
