// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// The amount of texture that a direct method can use: pixels whose gradient (central differences of the grey image) is
/// more than 8 grey levels of 255 per pixel, as a share of all pixels except those at the border.
struct TextureStatistic {
  double share = 0.0;                // of the whole image
  std::vector<double> block_shares;  // of each whole block of 32 x 32 pixels, row by row
};

/// Images smaller than 3 x 3 have share 0. Blocks that are not completely inside the image are left out; a block's
/// pixels at the image's border do not count. Grey values 0..1. The share depends on the image size, so only images of
/// similar size (320 x 240) should be compared.
TextureStatistic texture_statistic(const GrayImage& gray);

/// Mean of the images' shares, and the distribution of the shares of all their blocks.
struct TextureSummary {
  int images = 0;
  double share = 0.0;
  double block_p10 = 0.0;  // 10th percentile of the blocks' shares
  double block_p50 = 0.0;
  double block_p90 = 0.0;
  double bare_blocks = 0.0;  // share of the blocks with less than 1 % of such pixels
};

/// Zeros for an empty list.
TextureSummary summarise_texture(const std::vector<TextureStatistic>& statistics);

}  // namespace odosplat
