// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/raster/raster_pairs.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <string>
#include <vector>

#include "kernels/constants.h"

namespace odosplat {
namespace {

using compute::Range;

// Pair indices are 32-bit, and the kernels index with signed integers.
constexpr std::size_t max_pairs = std::size_t{1} << 31;

}  // namespace

RasterPairs::RasterPairs(const compute::Context& context, const compute::Program& program, bool long_chunks)
    : context_(context),
      long_chunks_(long_chunks),
      scan_(context),
      sort_(context),
      emit_pairs_(program.kernel("emit_pairs", "bin")),
      bin_histogram_(program.kernel("bin_histogram", "bin")),
      bin_totals_(program.kernel("bin_totals", "bin")),
      bin_cursors_(program.kernel("bin_cursors", "bin")),
      bin_scatter_(program.kernel("bin_scatter", "bin")),
      gather_counts_(program.kernel("gather_counts", "bin")),
      order_pairs_(program.kernel("order_pairs", "bin")),
      gather_pairs_(program.kernel("gather_pairs", "bin")) {}

void RasterPairs::build(std::size_t n, std::size_t lanes, const compute::Buffer<float>& boxes,
                        const compute::Buffer<std::uint32_t>& depth_keys, const compute::Buffer<std::uint32_t>& counts,
                        const std::array<std::int32_t, 4>& grid, const WantedTiles& wanted) {
  const auto count = static_cast<std::int32_t>(n);
  const std::size_t tiles = static_cast<std::size_t>(grid[2]) * static_cast<std::size_t>(grid[3]);
  offsets_.resize(context_, n + 1);
  tile_start_.resize(context_, tiles + 1);
  std::uint32_t total = 0;
  if (n > 0) {
    if (n * tiles >= max_pairs) {
      // Only here can the 32-bit sum of the scan wrap.
      const std::vector<std::uint32_t> all = counts.download();
      if (std::accumulate(all.begin(), all.end(), std::size_t{0}) >= max_pairs) {
        throw compute::DeviceError("more than 2^31 pairs of Gaussian and tile: " + std::to_string(n) +
                                   " Gaussians are too large for this image");
      }
    }
    scan_.exclusive(counts, n, offsets_);
    sort_.sort(depth_keys, n, order_);
    offsets_.download(&total, 1, n);
  }
  pairs_ = total;
  slot_tile_.resize(context_, pairs_);
  list_.resize(context_, pairs_);
  slot_.resize(context_, pairs_);
  if (pairs_ == 0) {
    tile_start_.fill_zero();
    return;
  }
  emit_pairs_(Range::linear((n + lanes - 1) / lanes, lanes > 1 ? 1 : ITEM_GROUP), count, boxes, offsets_, grid,
              wanted.sparse, wanted.blocks, slot_tile_);
  if (long_chunks_) {
    sort_in_chunks(n, tiles);
  } else {
    sort_by_radix(n, tiles, counts);
  }
}

void RasterPairs::sort_in_chunks(std::size_t n, std::size_t tiles) {
  const std::size_t wanted = std::clamp<std::size_t>(2 * std::size_t{context_.device().compute_units}, 8, 128);
  const std::size_t chunk_size = (n + wanted - 1) / wanted;
  const std::size_t chunks = (n + chunk_size - 1) / chunk_size;
  const auto n_arg = static_cast<std::int32_t>(n);
  const auto chunk_arg = static_cast<std::int32_t>(chunk_size);
  const auto tiles_arg = static_cast<std::int32_t>(tiles);
  const auto chunks_arg = static_cast<std::int32_t>(chunks);
  histogram_.resize(context_, chunks * tiles);
  totals_.resize(context_, tiles);
  bin_histogram_(Range::linear(chunks, 1), n_arg, chunk_arg, tiles_arg, order_, offsets_, slot_tile_, histogram_);
  bin_totals_(Range::linear(tiles, ITEM_GROUP), tiles_arg, chunks_arg, histogram_, totals_);
  scan_.exclusive(totals_, tiles, tile_start_);
  bin_cursors_(Range::linear(tiles, ITEM_GROUP), tiles_arg, chunks_arg, tile_start_, histogram_);
  bin_scatter_(Range::linear(chunks, 1), n_arg, chunk_arg, tiles_arg, order_, offsets_, slot_tile_, histogram_, list_,
               slot_);
}

void RasterPairs::sort_by_radix(std::size_t n, std::size_t tiles, const compute::Buffer<std::uint32_t>& counts) {
  const auto n_arg = static_cast<std::int32_t>(n);
  depth_counts_.resize(context_, n);
  depth_tile_.resize(context_, pairs_);
  depth_pair_.resize(context_, 2 * pairs_);
  gather_counts_(Range::linear(n, ITEM_GROUP), n_arg, order_, counts, depth_counts_);
  scan_.exclusive(depth_counts_, n, depth_offsets_);
  order_pairs_(Range::linear(n, ITEM_GROUP), n_arg, order_, offsets_, depth_offsets_, slot_tile_, depth_tile_,
               depth_pair_);
  sort_.sort(depth_tile_, pairs_, sorted_, static_cast<int>(std::bit_width(tiles)));
  gather_pairs_(Range::linear(pairs_, ITEM_GROUP), static_cast<std::uint32_t>(pairs_), static_cast<std::int32_t>(tiles),
                sorted_, depth_tile_, depth_pair_, list_, slot_, tile_start_);
}

}  // namespace odosplat
