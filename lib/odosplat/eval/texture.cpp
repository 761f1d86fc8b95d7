// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/texture.hpp"

#include <algorithm>

#include "odosplat/eval/statistics.hpp"

namespace odosplat {
namespace {

constexpr float strong = 8.0F;  // grey levels per pixel
constexpr int block = 32;       // pixels per side
constexpr double bare = 0.01;

struct Count {
  int strong = 0;
  int all = 0;
  double share() const { return all > 0 ? static_cast<double>(strong) / all : 0.0; }
};

Count count_strong(const GrayImage& gray, int x0, int y0, int x1, int y1) {
  Count count;
  for (int y = std::max(y0, 1); y < std::min(y1, gray.rows - 1); ++y) {
    for (int x = std::max(x0, 1); x < std::min(x1, gray.cols - 1); ++x) {
      const float gx = 127.5F * (gray(y, x + 1) - gray(y, x - 1));
      const float gy = 127.5F * (gray(y + 1, x) - gray(y - 1, x));
      ++count.all;
      if (gx * gx + gy * gy > strong * strong) ++count.strong;
    }
  }
  return count;
}

}  // namespace

TextureStatistic texture_statistic(const GrayImage& gray) {
  TextureStatistic statistic;
  statistic.share = count_strong(gray, 0, 0, gray.cols, gray.rows).share();
  for (int y = 0; y + block <= gray.rows; y += block) {
    for (int x = 0; x + block <= gray.cols; x += block) {
      statistic.block_shares.push_back(count_strong(gray, x, y, x + block, y + block).share());
    }
  }
  return statistic;
}

TextureSummary summarise_texture(const std::vector<TextureStatistic>& statistics) {
  TextureSummary summary;
  std::vector<double> blocks;
  for (const TextureStatistic& s : statistics) {
    summary.share += s.share / static_cast<double>(statistics.size());
    blocks.insert(blocks.end(), s.block_shares.begin(), s.block_shares.end());
  }
  std::sort(blocks.begin(), blocks.end());
  summary.images = static_cast<int>(statistics.size());
  summary.block_p10 = percentile(blocks, 10.0);
  summary.block_p50 = percentile(blocks, 50.0);
  summary.block_p90 = percentile(blocks, 90.0);
  const auto first = std::lower_bound(blocks.begin(), blocks.end(), bare);
  if (!blocks.empty())
    summary.bare_blocks = static_cast<double>(first - blocks.begin()) / static_cast<double>(blocks.size());
  return summary;
}

}  // namespace odosplat
