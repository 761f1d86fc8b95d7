// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "odosplat/compute/program.hpp"
#include "odosplat/compute/radix_sort.hpp"
#include "odosplat/compute/scan.hpp"

namespace odosplat {

/// Which tiles are rendered: all, or if `sparse` those with a bit set in `blocks` [tiles]: bit b for block b of 4 x 4
/// pixels.
struct WantedTiles {
  std::int32_t sparse = 0;
  compute::Buffer<std::uint32_t> blocks;
};

/// Lists of the Gaussians that each tile of an image shows, from near to far. Steps:
/// 1. scan of the number of tiles of each Gaussian (a pair's place in it is its slot),
/// 2. tiles written to the slots,
/// 3. radix sort of the Gaussians by depth,
/// 4. stable sort of the pairs by tile in that order: a counting sort over a few long chunks if `long_chunks` (CPUs),
///    else a radix sort. Both give the same lists; equal depths keep the order of the Gaussians.
/// Not thread safe. Waits once, for the number of pairs. Throws compute::DeviceError.
class RasterPairs {
 public:
  RasterPairs(const compute::Context& context, const compute::Program& program, bool long_chunks);

  /// boxes, depth_keys [N] and counts [N] (tiles of each Gaussian) as project.cl writes them for `lanes` Gaussians per
  /// work-item; grid: width, height [px], tiles per row, rows of tiles; wanted: which tiles count.
  void build(std::size_t n, std::size_t lanes, const compute::Buffer<float>& boxes,
             const compute::Buffer<std::uint32_t>& depth_keys, const compute::Buffer<std::uint32_t>& counts,
             const std::array<std::int32_t, 4>& grid, const WantedTiles& wanted);

  std::size_t size() const { return pairs_; }
  const compute::Buffer<std::uint32_t>& offsets() const { return offsets_; }        // [N + 1] its first slot
  const compute::Buffer<std::uint32_t>& tile_start() const { return tile_start_; }  // [tiles + 1] into list
  const compute::Buffer<std::uint32_t>& list() const { return list_; }              // [pairs] Gaussian
  const compute::Buffer<std::uint32_t>& slot() const { return slot_; }              // [pairs] slot of the pair

 private:
  void sort_in_chunks(std::size_t n, std::size_t tiles);
  void sort_by_radix(std::size_t n, std::size_t tiles, const compute::Buffer<std::uint32_t>& counts);

  compute::Context context_;
  bool long_chunks_;
  compute::Scan scan_;
  compute::RadixSort sort_;
  compute::Kernel emit_pairs_;
  compute::Kernel bin_histogram_, bin_totals_, bin_cursors_, bin_scatter_;  // long chunks
  compute::Kernel gather_counts_, order_pairs_, gather_pairs_;              // radix
  std::size_t pairs_ = 0;
  compute::Buffer<std::uint32_t> offsets_, order_, slot_tile_, list_, slot_, tile_start_;
  compute::Buffer<std::uint32_t> histogram_, totals_;
  compute::Buffer<std::uint32_t> depth_counts_, depth_offsets_, depth_tile_, depth_pair_, sorted_;
};

}  // namespace odosplat
