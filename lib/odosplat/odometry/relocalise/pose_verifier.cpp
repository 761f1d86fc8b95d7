// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/pose_verifier.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

/// Sums over pairs of grey values.
struct PairSums {
  double n = 0.0;
  double a = 0.0;
  double b = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;

  void add(double va, double vb) {
    n += 1.0;
    a += va;
    b += vb;
    aa += va * va;
    bb += vb * vb;
    ab += va * vb;
  }
  void add(const PairSums& other) {
    n += other.n;
    a += other.a;
    b += other.b;
    aa += other.aa;
    bb += other.bb;
    ab += other.ab;
  }
  double spread_a() const { return std::sqrt(std::max(0.0, aa / n - a / n * a / n)); }
  double spread_b() const { return std::sqrt(std::max(0.0, bb / n - b / n * b / n)); }
  /// For two that hardly vary: close to 0, not a ratio of rounding errors.
  double correlation() const {
    constexpr double floor = 0.5 / 255;
    return (ab / n - a / n * b / n) / (std::max(floor, spread_a()) * std::max(floor, spread_b()));
  }
};

}  // namespace

void PoseVerifierOptions::check() const {
  require(block >= 4, "verifier.block", "at least 4 px");
  require(block_depth_share > 0.0 && block_depth_share <= 1.0, "verifier.block_depth_share", "in (0, 1]");
  require(min_texture > 0.0, "verifier.min_texture", "positive");
  require(min_blocks >= 1, "verifier.min_blocks", "at least 1");
  require(min_coverage >= 0.0 && min_coverage <= 1.0, "verifier.min_coverage", "in [0, 1]");
  require(min_score >= -1.0 && min_score <= 1.0, "verifier.min_score", "in [-1, 1]");
}

bool is_held_back(double u, double v, int block) {
  return ((static_cast<int>(u + 0.5) / block + static_cast<int>(v + 0.5) / block) & 1) != 0;
}

TrackingReference without_held_back(const TrackingReference& reference, int block) {
  TrackingReference kept;
  kept.cameras = reference.cameras;
  kept.levels.resize(reference.levels.size());
  for (std::size_t level = 0; level < reference.levels.size(); ++level) {
    const double scale = std::ldexp(1.0, static_cast<int>(level));
    std::copy_if(reference.levels[level].begin(), reference.levels[level].end(), std::back_inserter(kept.levels[level]),
                 [&](const ReferencePoint& p) {
                   return !is_held_back((p.u + 0.5) * scale - 0.5, (p.v + 0.5) * scale - 0.5, block);
                 });
  }
  return kept;
}

PoseEvidence compare_with_map(const GrayImage& image, const GrayImage& rendered, const DepthImage& depth,
                              const PoseVerifierOptions& options) {
  PoseEvidence evidence;
  evidence.coverage = static_cast<double>(cv::countNonZero(depth)) / static_cast<double>(depth.total());
  double sum = 0.0;
  for (int top = 0; top < image.rows; top += options.block) {
    for (int left = 0; left < image.cols; left += options.block) {
      if (!is_held_back(left, top, options.block)) continue;
      PairSums block;
      const int bottom = std::min(image.rows, top + options.block);
      const int right = std::min(image.cols, left + options.block);
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) {
          if (depth(y, x) > 0.0F) block.add(image(y, x), rendered(y, x));
        }
      }
      if (block.n < options.block_depth_share * options.block * options.block) continue;
      if (std::max(block.spread_a(), block.spread_b()) < options.min_texture) continue;
      sum += block.correlation();
      ++evidence.blocks;
    }
  }
  if (evidence.blocks > 0) evidence.score = sum / evidence.blocks;
  return evidence;
}

std::string fault_of(const PoseEvidence& evidence, const PoseVerifierOptions& options) {
  char text[96] = "";
  if (evidence.coverage < options.min_coverage) {
    std::snprintf(text, sizeof(text), "the map covers %.0f %% of the view", 100.0 * evidence.coverage);
  } else if (evidence.blocks < options.min_blocks) {
    std::snprintf(text, sizeof(text), "only %d parts of the view have texture", evidence.blocks);
  } else if (evidence.score < options.min_score) {
    std::snprintf(text, sizeof(text), "image and map agree by %.2f", evidence.score);
  }
  return text;
}

}  // namespace odosplat
