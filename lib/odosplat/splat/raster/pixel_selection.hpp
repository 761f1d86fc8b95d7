// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "odosplat/compute/program.hpp"
#include "odosplat/compute/scan.hpp"
#include "odosplat/splat/raster/device_gaussians.hpp"
#include "odosplat/splat/raster/raster_pairs.hpp"
#include "odosplat/splat/raster/viewpoint.hpp"

namespace odosplat {

/// What is needed to render only some pixels of an image: the tiles and blocks of 4 x 4 pixels that contain them, and
/// the Gaussians that may touch those blocks (a superset of those that do, in their order). Not thread safe.
class PixelSelection {
 public:
  /// lanes: Gaussians that a work-item handles side by side, 1 or 8.
  PixelSelection(const compute::Context& context, std::size_t lanes);

  /// Waits once, for the number of Gaussians. Pixels may repeat; InputError for one outside the image.
  void select(const DeviceGaussians& gaussians, const Viewpoint& view, float dilation,
              const std::vector<cv::Point>& pixels);

  std::size_t size() const { return size_; }                                     // Gaussians selected
  const compute::Buffer<std::uint32_t>& gaussians() const { return selected_; }  // [size] their indices, ascending
  const WantedTiles& tiles() const { return tiles_; }

  /// The selected pixels' values [planes x pixels] out of an image [planes x H x W] in the order given to select.
  /// Queued.
  void pick(const compute::Buffer<float>& image, compute::Buffer<float>& picked);

 private:
  void mark(const Viewpoint& view, const std::vector<cv::Point>& pixels);

  compute::Context context_;
  compute::Program program_;
  compute::Kernel keep_, join_, pick_;
  compute::Scan scan_;
  std::size_t size_ = 0, pixels_ = 0;
  std::vector<std::int32_t> places_;
  std::vector<std::uint32_t> blocks_, sums_;
  compute::Buffer<std::int32_t> device_places_;
  compute::Buffer<std::uint32_t> device_sums_, kept_, kept_counts_, starts_, selected_;
  WantedTiles tiles_;
};

}  // namespace odosplat
