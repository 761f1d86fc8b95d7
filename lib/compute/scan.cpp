// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/scan.hpp"

namespace odosplat::compute {
namespace {

// Chunks of 4096 keep two CPU cores busy from 8192 elements on; a GPU wants more and shorter ones.
std::uint32_t chunk_size(const Context& context) { return context.is_cpu() ? 4096U : 256U; }

}  // namespace

Scan::Scan(const Context& context)
    : context_(context),
      program_(context, {"scan.cl"}),
      chunk_sums_(program_.kernel("scan_chunk_sums", "scan")),
      scan_sums_(program_.kernel("scan_sums", "scan")),
      write_(program_.kernel("scan_write", "scan")) {}

void Scan::exclusive(const Buffer<std::uint32_t>& counts, std::size_t n, Buffer<std::uint32_t>& out) {
  const std::uint32_t chunk = chunk_size(context_);
  const std::size_t chunks = (n + chunk - 1) / chunk;
  const auto size = static_cast<std::uint32_t>(n);
  out.resize(context_, n + 1);
  sums_.resize(context_, chunks);
  const std::size_t local = context_.is_cpu() ? 1 : 64;
  chunk_sums_(Range::linear(chunks, local), counts, sums_, size, chunk);
  scan_sums_(Range::linear(1, 1), sums_, out, static_cast<std::uint32_t>(chunks), size);
  write_(Range::linear(chunks, local), counts, sums_, out, size, chunk);
}

}  // namespace odosplat::compute
