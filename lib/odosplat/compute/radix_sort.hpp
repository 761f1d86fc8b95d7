// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "odosplat/compute/program.hpp"
#include "odosplat/compute/scan.hpp"

namespace odosplat::compute {

/// Stable least-significant-digit radix sort of 32-bit keys: passes of 11 bits over chunks, of 4 bits over groups.
/// Positive floats have the same order as their bits, so depths can be passed as keys with as_uint.
class RadixSort {
 public:
  explicit RadixSort(const Context& context, Layout layout = Layout::automatic);

  /// order[r] = index of the key with rank r; equal keys keep their order. `keys` (n keys, each below 2^bits, bits
  /// 1..32) is not changed; `order` is resized to n. The result does not depend on device or threads. Queued, not
  /// waited for.
  void sort(const Buffer<std::uint32_t>& keys, std::size_t n, Buffer<std::uint32_t>& order, int bits = 32);

 private:
  struct Pass {
    std::size_t n = 0;
    std::uint32_t shift = 0;
    std::int32_t first = 0;  // the input order is 0, 1, 2, ...
  };
  void pass_over_chunks(const Pass& pass, const Buffer<std::uint32_t>& keys, const Buffer<std::uint32_t>& in,
                        const Buffer<std::uint32_t>& out);
  void pass_over_groups(const Pass& pass, const Buffer<std::uint32_t>& keys, const Buffer<std::uint32_t>& in,
                        const Buffer<std::uint32_t>& out);

  Context context_;
  bool groups_;
  Program program_;
  Kernel histogram_, scatter_;
  std::vector<Kernel> offsets_;  // chunks: starts of chunks within digits, then of digits
  Scan scan_;                    // groups
  Buffer<std::uint32_t> counts_, totals_, other_;
};

}  // namespace odosplat::compute
