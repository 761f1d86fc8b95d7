// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/radix_sort.hpp"

#include <algorithm>
#include <string>

#include "kernels/constants.h"

namespace odosplat::compute {
namespace {

// Few chunks, because each has a table of 2048 counts: 32 chunks took three times as long as 8.
constexpr std::size_t most_chunks = 8;

std::vector<std::string> files_of(bool groups) {
  if (groups) return {"group_scan.cl", "group_radix.cl"};
  return {"radix_sort.cl"};
}

}  // namespace

RadixSort::RadixSort(const Context& context, Layout layout)
    : context_(context),
      groups_(chosen_layout(layout, context) == Layout::groups),
      program_(context, files_of(groups_)),
      histogram_(program_.kernel(groups_ ? "group_radix_histogram" : "radix_histogram", "sort")),
      scatter_(program_.kernel(groups_ ? "group_radix_scatter" : "radix_scatter", "sort")),
      scan_(context, layout),
      totals_(context, RADIX_SIZE) {
  if (!groups_)
    offsets_ = {program_.kernel("radix_chunk_offsets", "sort"), program_.kernel("radix_digit_offsets", "sort")};
}

void RadixSort::sort(const Buffer<std::uint32_t>& keys, std::size_t n, Buffer<std::uint32_t>& order, int bits) {
  order.resize(context_, n);
  if (n == 0) return;
  other_.resize(context_, n);
  const int bits_a_pass = groups_ ? RADIX_GROUP_BITS : RADIX_BITS;
  const int passes = (std::clamp(bits, 1, 32) + bits_a_pass - 1) / bits_a_pass;
  for (int i = 0; i < passes; ++i) {
    // The two buffers alternate so that the last pass writes to `order`; the first pass does not read its input order.
    const bool into_order = (passes - 1 - i) % 2 == 0;
    const Buffer<std::uint32_t>& in = into_order ? other_ : order;
    const Buffer<std::uint32_t>& out = into_order ? order : other_;
    const Pass pass{n, static_cast<std::uint32_t>(i * bits_a_pass), i == 0 ? 1 : 0};
    if (groups_) {
      pass_over_groups(pass, keys, in, out);
    } else {
      pass_over_chunks(pass, keys, in, out);
    }
  }
}

void RadixSort::pass_over_chunks(const Pass& pass, const Buffer<std::uint32_t>& keys, const Buffer<std::uint32_t>& in,
                                 const Buffer<std::uint32_t>& out) {
  const std::size_t chunk = std::max<std::size_t>(256, (pass.n + most_chunks - 1) / most_chunks);
  const std::size_t chunks = (pass.n + chunk - 1) / chunk;
  counts_.resize(context_, chunks * RADIX_SIZE);
  const auto n = static_cast<std::uint32_t>(pass.n);
  const auto chunk32 = static_cast<std::uint32_t>(chunk);
  const auto chunks32 = static_cast<std::uint32_t>(chunks);
  const Range by_chunk = Range::linear(chunks, 1);
  histogram_(by_chunk, keys, in, counts_, n, chunk32, chunks32, pass.shift, pass.first);
  offsets_[0](Range::linear(RADIX_SIZE, 64), counts_, totals_, chunks32);
  offsets_[1](Range::linear(1, 1), totals_);
  scatter_(by_chunk, keys, in, counts_, totals_, out, n, chunk32, chunks32, pass.shift, pass.first);
}

void RadixSort::pass_over_groups(const Pass& pass, const Buffer<std::uint32_t>& keys, const Buffer<std::uint32_t>& in,
                                 const Buffer<std::uint32_t>& out) {
  const std::size_t groups = (pass.n + RADIX_GROUP_KEYS - 1) / RADIX_GROUP_KEYS;
  const auto n = static_cast<std::uint32_t>(pass.n);
  const Range range = Range::linear(groups * SCAN_GROUP, SCAN_GROUP);
  counts_.resize(context_, RADIX_DIGITS * groups);
  histogram_(range, keys, in, counts_, n, pass.shift, pass.first);
  scan_.exclusive(counts_, RADIX_DIGITS * groups, totals_);
  scatter_(range, keys, in, totals_, out, n, pass.shift, pass.first);
}

}  // namespace odosplat::compute
