// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/points/pixel_selector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

constexpr int directions = 16;

// Bits of a candidate: the levels whose gradient there is above the threshold.
constexpr uchar on_no_level = 0;
constexpr uchar on_level0 = 1;
constexpr uchar on_level1 = 2;
constexpr uchar on_level2 = 4;

/// Best pixel of a cell so far.
struct Best {
  cv::Point pixel{-1, -1};
  float score = 0.0F;
  void offer(const cv::Point& p, float s) {
    if (s > score) {
      pixel = p;
      score = s;
    }
  }
  bool found() const { return pixel.x >= 0; }
};

float score(const float* g, const cv::Point2f& direction) { return std::abs(g[1] * direction.x + g[2] * direction.y); }

}  // namespace

void SelectorOptions::check() const {
  require(block >= 8, "selector.block", "at least 8 px");
  require(quantile > 0.0 && quantile < 1.0, "selector.quantile", "between 0 and 1");
  require(offset >= 0.0, "selector.offset", "at least 0");
  require(level_factor > 0.0 && level_factor <= 1.0, "selector.level_factor", "in (0, 1]");
  require(border >= 2, "selector.border", "at least 2 px");
}

PixelSelector::PixelSelector(const SelectorOptions& options) : options_(options) { options_.check(); }

cv::Mat1f PixelSelector::thresholds(const GradientImage& gradient) const {
  constexpr int bins = 256;
  constexpr float bins_per_unit = 512.0F;  // gradients above half the grey range share the last bin
  const int block = options_.block;
  const cv::Size regions(std::max(1, gradient.cols / block), std::max(1, gradient.rows / block));
  cv::Mat1f raw(regions);
  for (int j = 0; j < regions.height; ++j) {
    for (int i = 0; i < regions.width; ++i) {
      // The last region of a row or column takes the remainder.
      const int x1 = i + 1 == regions.width ? gradient.cols : (i + 1) * block;
      const int y1 = j + 1 == regions.height ? gradient.rows : (j + 1) * block;
      std::array<int, bins> histogram{};
      int total = 0;
      for (int y = j * block; y < y1; ++y) {
        const float* g = gradient.ptr<float>(y) + 4 * i * block;
        for (int x = i * block; x < x1; ++x, g += 4) {
          ++histogram[static_cast<std::size_t>(std::min(bins - 1.0F, std::sqrt(g[3]) * bins_per_unit))];
          ++total;
        }
      }
      int below = 0;
      std::size_t bin = 0;
      while (bin < bins - 1 && below + histogram[bin] <= options_.quantile * total) below += histogram[bin++];
      raw(j, i) = static_cast<float>(bin) / bins_per_unit + static_cast<float>(options_.offset);
    }
  }
  cv::Mat1f smooth(regions);
  for (int j = 0; j < regions.height; ++j) {
    for (int i = 0; i < regions.width; ++i) {
      float sum = 0.0F;
      int n = 0;
      for (int y = std::max(0, j - 1); y <= std::min(regions.height - 1, j + 1); ++y) {
        for (int x = std::max(0, i - 1); x <= std::min(regions.width - 1, i + 1); ++x, ++n) sum += raw(y, x);
      }
      smooth(j, i) = sum / static_cast<float>(n);
    }
  }
  return smooth;
}

cv::Mat1b PixelSelector::candidates(std::span<const GradientImage> gradients, const cv::Mat1b& mask) const {
  const GradientImage& full = gradients[0];
  cv::Mat1f threshold_of_region = thresholds(full);
  for (float& t : threshold_of_region) t *= t;
  const float factor1 = static_cast<float>(options_.level_factor * options_.level_factor);
  const float factor2 = factor1 * factor1;
  const auto reach = [&](std::size_t level, int GradientImage::*side) {
    return gradients.size() > level ? gradients[level].*side << level : 0;
  };
  const int cols1 = std::min(reach(1, &GradientImage::cols), full.cols);
  const int cols2 = std::min(reach(2, &GradientImage::cols), full.cols);
  const int rows1 = reach(1, &GradientImage::rows);
  const int rows2 = reach(2, &GradientImage::rows);
  std::vector<float> threshold(static_cast<std::size_t>(full.cols));
  cv::Mat1b levels(full.size(), on_no_level);
  for (int y = options_.border; y < full.rows - options_.border; ++y) {
    const float* regions = threshold_of_region[std::min(y / options_.block, threshold_of_region.rows - 1)];
    for (int x = 0; x < full.cols; ++x) {
      threshold[static_cast<std::size_t>(x)] = regions[std::min(x / options_.block, threshold_of_region.cols - 1)];
    }
    const float* t = threshold.data();
    uchar* out = levels[y];
    const float* g = full.ptr<float>(y) + 3;
    for (int x = 0; x < full.cols; ++x) out[x] = g[4 * x] > t[x] ? on_level0 : on_no_level;
    if (y < rows1) {
      const float* h = gradients[1].ptr<float>(y / 2) + 3;
      for (int x = 0; x < cols1; ++x)
        out[x] = static_cast<uchar>(out[x] | (h[4 * (x / 2)] > t[x] * factor1 ? on_level1 : on_no_level));
    }
    if (y < rows2) {
      const float* h = gradients[2].ptr<float>(y / 4) + 3;
      for (int x = 0; x < cols2; ++x)
        out[x] = static_cast<uchar>(out[x] | (h[4 * (x / 4)] > t[x] * factor2 ? on_level2 : on_no_level));
    }
    if (mask.empty()) continue;
    const uchar* allowed = mask[y];
    for (int x = 0; x < full.cols; ++x) out[x] = allowed[x] != 0 ? out[x] : on_no_level;
  }
  return levels;
}

std::vector<cv::Point> PixelSelector::pick(std::span<const GradientImage> gradients, const cv::Mat1b& levels,
                                           int cell) const {
  std::array<cv::Point2f, directions> direction;
  for (int k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * k / directions;
    direction[static_cast<std::size_t>(k)] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  }
  Random random(options_.seed);
  const auto any_direction = [&] { return direction[random.below(directions)]; };
  const int rows = levels.rows - options_.border;
  const int cols = levels.cols - options_.border;
  std::vector<cv::Point> picked;
  for (int y4 = options_.border; y4 < rows; y4 += 4 * cell) {
    for (int x4 = options_.border; x4 < cols; x4 += 4 * cell) {
      Best best4;
      bool any4 = false;
      const cv::Point2f direction4 = any_direction();
      for (int quarter = 0; quarter < 4; ++quarter) {
        const int x2 = x4 + (quarter & 1) * 2 * cell;
        const int y2 = y4 + (quarter >> 1) * 2 * cell;
        Best best2;
        bool any2 = false;
        const cv::Point2f direction2 = any_direction();
        for (int sixteenth = 0; sixteenth < 4; ++sixteenth) {
          const int x1 = x2 + (sixteenth & 1) * cell;
          const int y1 = y2 + (sixteenth >> 1) * cell;
          Best best1;
          const cv::Point2f direction1 = any_direction();
          for (int y = y1; y < std::min(y1 + cell, rows); ++y) {
            const uchar* candidate = levels[y];
            for (int x = x1; x < std::min(x1 + cell, cols); ++x) {
              if (candidate[x] == on_no_level) continue;
              const auto gradient = [&](std::size_t level) {
                return gradients[level].ptr<float>(y >> level) + 4 * (x >> level);
              };
              if ((candidate[x] & on_level0) != 0) best1.offer({x, y}, score(gradient(0), direction1));
              if ((candidate[x] & on_level1) != 0) best2.offer({x, y}, score(gradient(1), direction2));
              if ((candidate[x] & on_level2) != 0) best4.offer({x, y}, score(gradient(2), direction4));
            }
          }
          if (best1.found()) {
            picked.push_back(best1.pixel);
            any2 = true;
          }
        }
        if (!any2 && best2.found()) {
          picked.push_back(best2.pixel);
          any2 = true;
        }
        any4 = any4 || any2;
      }
      if (!any4 && best4.found()) picked.push_back(best4.pixel);
    }
  }
  return picked;
}

std::vector<cv::Point> PixelSelector::select(std::span<const GradientImage> gradients, const cv::Mat1b& mask,
                                             int wanted) {
  if (gradients.empty() || gradients[0].empty() || wanted <= 0) return {};
  const cv::Mat1b levels = candidates(gradients, mask);
  std::vector<cv::Point> picked = pick(gradients, levels, cell_);
  // The number of pixels falls about with the square of the cell's side; two corrections at most.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const double ratio = static_cast<double>(picked.size()) / wanted;
    if (ratio >= 0.8 && ratio <= 1.6) break;
    const int better = std::clamp(static_cast<int>(std::lround((cell_ + 0.5) * std::sqrt(ratio) - 0.5)), 1, 64);
    if (better == cell_) break;
    cell_ = better;
    picked = pick(gradients, levels, cell_);
  }
  if (static_cast<double>(picked.size()) > 1.25 * wanted) {
    Random random(options_.seed + 1);
    const double keep = static_cast<double>(wanted) / static_cast<double>(picked.size());
    std::erase_if(picked, [&](const cv::Point&) { return random.uniform() >= keep; });
    if (static_cast<double>(picked.size()) > 1.25 * wanted) picked.resize(static_cast<std::size_t>(1.25 * wanted));
  }
  return picked;
}

}  // namespace odosplat
