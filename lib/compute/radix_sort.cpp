// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/radix_sort.hpp"

#include <algorithm>

#include "odosplat/kernels/constants.h"

namespace odosplat::compute {
namespace {

// Few chunks on a CPU (32 were three times slower than 8: every chunk drags a table of 2048 counts along).
constexpr std::size_t cpu_chunks = 8;
constexpr std::size_t gpu_chunks = 512;

}  // namespace

RadixSort::RadixSort(const Context& context)
    : context_(context),
      program_(context, {"radix_sort.cl"}),
      histogram_(program_.kernel("radix_histogram", "sort")),
      chunk_offsets_(program_.kernel("radix_chunk_offsets", "sort")),
      digit_offsets_(program_.kernel("radix_digit_offsets", "sort")),
      scatter_(program_.kernel("radix_scatter", "sort")),
      totals_(context, RADIX_SIZE) {}

void RadixSort::sort(const Buffer<std::uint32_t>& keys, std::size_t n, Buffer<std::uint32_t>& order) {
  order.resize(context_, n);
  if (n == 0) return;
  other_.resize(context_, n);
  const std::size_t wanted = context_.is_cpu() ? cpu_chunks : gpu_chunks;
  const std::size_t chunk = std::max<std::size_t>(256, (n + wanted - 1) / wanted);
  const std::size_t chunks = (n + chunk - 1) / chunk;
  counts_.resize(context_, chunks * RADIX_SIZE);
  const auto n32 = static_cast<std::uint32_t>(n);
  const auto chunk32 = static_cast<std::uint32_t>(chunk);
  const auto chunks32 = static_cast<std::uint32_t>(chunks);
  const Range by_chunk = Range::linear(chunks, 1);
  // Three passes: the first reads no order, so that the last one ends in `order`.
  for (std::int32_t pass = 0; pass < 3; ++pass) {
    const auto shift = static_cast<std::uint32_t>(pass * RADIX_BITS);
    const std::int32_t first = pass == 0 ? 1 : 0;
    const Buffer<std::uint32_t>& in = pass == 1 ? order : other_;
    const Buffer<std::uint32_t>& out = pass == 1 ? other_ : order;
    histogram_(by_chunk, keys, in, counts_, n32, chunk32, chunks32, shift, first);
    chunk_offsets_(Range::linear(RADIX_SIZE, 64), counts_, totals_, chunks32);
    digit_offsets_(Range::linear(1, 1), totals_);
    scatter_(by_chunk, keys, in, counts_, totals_, out, n32, chunk32, chunks32, shift, first);
  }
}

}  // namespace odosplat::compute
