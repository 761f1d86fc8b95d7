// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// How much there is for a direct method to hold on to: pixels whose gradient (central differences of the grey image)
/// is more than 8 grey levels of 255 a pixel, as a share of all pixels but the border's.
struct TextureStatistic {
  double share = 0.0;                // of the whole image
  std::vector<double> block_shares;  // of each whole block of 32 x 32 pixels, row by row
};

/// Images smaller than 3 x 3 have no share: 0. Blocks that the image's border cuts are left out; a block's pixels on
/// the image's border do not count. Grey values 0..1. Compare images of like size (320 x 240): the share depends on it.
TextureStatistic texture_statistic(const GrayImage& gray);

/// Mean of the images' shares, and how the blocks of all of them spread.
struct TextureSummary {
  int images = 0;
  double share = 0.0;
  double block_p10 = 0.0;  // a tenth of the blocks has less
  double block_p50 = 0.0;
  double block_p90 = 0.0;
  double bare_blocks = 0.0;  // share of the blocks with less than 1 % of such pixels
};

/// No statistics: zeros.
TextureSummary summarise_texture(const std::vector<TextureStatistic>& statistics);

}  // namespace odosplat
