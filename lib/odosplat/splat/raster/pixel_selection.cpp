// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/raster/pixel_selection.hpp"

#include <algorithm>
#include <string>

#include "kernels/constants.h"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

using compute::Range;

constexpr int raster_block = 4;  // BLOCK of raster_common.cl
// Gaussians of a work-item: long runs for the few threads of a CPU, short ones for a GPU.
constexpr std::size_t cpu_chunk = 2048;
constexpr std::size_t gpu_chunk = 16;

}  // namespace

PixelSelection::PixelSelection(const compute::Context& context, std::size_t lanes)
    : context_(context),
      program_(context, {"raster_common.cl", "projection.cl", "select.cl"}, "-D GW=" + std::to_string(lanes)),
      keep_(program_.kernel("keep_near_wanted", "select")),
      join_(program_.kernel("join_kept", "select")),
      pick_(program_.kernel("pick_pixels", "select")),
      scan_(context) {
  tiles_.sparse = 1;
}

// Marks the blocks, and sums the marks over all rectangles that begin at the image's first corner.
void PixelSelection::mark(const Viewpoint& view, const std::vector<cv::Point>& pixels) {
  const auto [width, height, columns, rows] = view.grid;
  const auto stride = static_cast<std::size_t>((width + raster_block - 1) / raster_block) + 1;
  const auto block_rows = static_cast<std::size_t>((height + raster_block - 1) / raster_block);
  places_.clear();
  blocks_.assign(view.tiles, 0);
  sums_.assign(stride * (block_rows + 1), 0);
  for (const cv::Point& p : pixels) {
    if (p.x < 0 || p.x >= width || p.y < 0 || p.y >= height) {
      throw InputError("pixel " + std::to_string(p.x) + " " + std::to_string(p.y),
                       "outside the image of " + std::to_string(width) + " x " + std::to_string(height));
    }
    places_.push_back(p.y * width + p.x);
    const int in_tile =
        p.y % TILE_HEIGHT / raster_block * (TILE_WIDTH / raster_block) + p.x % TILE_WIDTH / raster_block;
    const int tile = p.y / TILE_HEIGHT * columns + p.x / TILE_WIDTH;
    blocks_[static_cast<std::size_t>(tile)] |= 1U << in_tile;
    sums_[static_cast<std::size_t>(p.y / raster_block + 1) * stride +
          static_cast<std::size_t>(p.x / raster_block + 1)] = 1;
  }
  for (std::size_t y = 1; y <= block_rows; ++y) {
    std::uint32_t row = 0;
    for (std::size_t x = 1; x < stride; ++x) {
      row += sums_[y * stride + x];
      sums_[y * stride + x] = sums_[(y - 1) * stride + x] + row;
    }
  }
}

void PixelSelection::select(const DeviceGaussians& gaussians, const Viewpoint& view, float dilation,
                            const std::vector<cv::Point>& pixels) {
  mark(view, pixels);
  pixels_ = view.pixels;
  size_ = 0;
  const std::size_t n = pixels.empty() ? 0 : gaussians.size();
  device_places_.resize(context_, places_.size());
  device_places_.upload(places_);
  tiles_.blocks.resize(context_, blocks_.size());
  tiles_.blocks.upload(blocks_);
  device_sums_.resize(context_, sums_.size());
  device_sums_.upload(sums_);
  const std::size_t chunk = context_.is_cpu() ? cpu_chunk : gpu_chunk;
  const std::size_t chunks = (n + chunk - 1) / chunk;
  kept_.resize(context_, chunks * chunk);
  kept_counts_.resize(context_, chunks);
  selected_.resize(context_, n);
  if (n == 0) return;
  const auto chunk_arg = static_cast<std::int32_t>(chunk);
  keep_(Range::linear(chunks, 1), static_cast<std::int32_t>(n), chunk_arg, gaussians.positions, gaussians.log_scales,
        view.pose, view.lens, view.grid, dilation,
        static_cast<std::int32_t>((view.grid[0] + raster_block - 1) / raster_block), device_sums_, kept_, kept_counts_);
  scan_.exclusive(kept_counts_, chunks, starts_);
  join_(Range::linear(chunks, 1), chunk_arg, kept_, kept_counts_, starts_, selected_);
  std::uint32_t total = 0;
  starts_.download(&total, 1, chunks);
  size_ = total;
}

void PixelSelection::pick(const compute::Buffer<float>& image, compute::Buffer<float>& picked) {
  const std::size_t planes = pixels_ > 0 ? image.size() / pixels_ : 0;
  picked.resize(context_, planes * places_.size());
  if (picked.empty()) return;
  pick_(Range::linear(places_.size(), ITEM_GROUP), static_cast<std::int32_t>(places_.size()), device_places_,
        static_cast<std::int32_t>(planes), static_cast<std::int32_t>(pixels_), image, picked);
}

}  // namespace odosplat
