// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>

#include "odosplat/compute/program.hpp"

namespace odosplat::compute {

/// Stable least-significant-digit radix sort of 32-bit keys, three passes of 11 bits (11 + 11 + 10).
/// Positive floats sort as their bits, so depths can be handed over with as_uint.
class RadixSort {
 public:
  explicit RadixSort(const Context& context);

  /// order[r] = index of the key that has rank r; equal keys keep their order. `keys` (n of them) is left alone;
  /// `order` is resized to n. The result does not depend on device or threads. Queued.
  void sort(const Buffer<std::uint32_t>& keys, std::size_t n, Buffer<std::uint32_t>& order);

 private:
  Context context_;
  Program program_;
  Kernel histogram_;
  Kernel chunk_offsets_;
  Kernel digit_offsets_;
  Kernel scatter_;
  Buffer<std::uint32_t> counts_;
  Buffer<std::uint32_t> totals_;
  Buffer<std::uint32_t> other_;
};

}  // namespace odosplat::compute
