// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/scan.hpp"

#include "kernels/constants.h"

namespace odosplat::compute {
namespace {

// Two chunks, enough to occupy two CPU cores, from 8192 elements on.
constexpr std::uint32_t chunk_size = 4096;

}  // namespace

Layout chosen_layout(Layout wanted, const Context& context) {
  if (wanted != Layout::automatic) return wanted;
  return context.is_cpu() ? Layout::chunks : Layout::groups;
}

Scan::Scan(const Context& context, Layout layout)
    : context_(context),
      groups_(chosen_layout(layout, context) == Layout::groups),
      program_(context, {groups_ ? "group_scan.cl" : "scan.cl"}),
      sums_kernel_(program_.kernel(groups_ ? "group_scan_sums" : "scan_chunk_sums", "scan")),
      starts_kernel_(program_.kernel(groups_ ? "group_scan_starts" : "scan_sums", "scan")),
      write_kernel_(program_.kernel(groups_ ? "group_scan_write" : "scan_write", "scan")) {}

void Scan::exclusive(const Buffer<std::uint32_t>& counts, std::size_t n, Buffer<std::uint32_t>& out) {
  const std::uint32_t chunk = groups_ ? SCAN_BLOCK : chunk_size;
  const std::size_t chunks = (n + chunk - 1) / chunk;
  const auto size = static_cast<std::uint32_t>(n);
  const auto chunks32 = static_cast<std::uint32_t>(chunks);
  out.resize(context_, n + 1);
  sums_.resize(context_, chunks);
  if (groups_) {
    const Range blocks = Range::linear(chunks * SCAN_GROUP, SCAN_GROUP);
    sums_kernel_(blocks, counts, sums_, size);
    starts_kernel_(Range::linear(SCAN_GROUP, SCAN_GROUP), sums_, out, chunks32, size);
    write_kernel_(blocks, counts, sums_, out, size);
    return;
  }
  sums_kernel_(Range::linear(chunks, 1), counts, sums_, size, chunk);
  starts_kernel_(Range::linear(1, 1), sums_, out, chunks32, size);
  write_kernel_(Range::linear(chunks, 1), counts, sums_, out, size, chunk);
}

}  // namespace odosplat::compute
