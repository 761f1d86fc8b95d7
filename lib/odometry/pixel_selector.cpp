// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/pixel_selector.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

constexpr int directions = 16;

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

std::vector<cv::Point> PixelSelector::pick(std::span<const GradientImage> gradients, const cv::Mat1b& mask,
                                           const cv::Mat1f& squared_thresholds, int cell) const {
  std::array<cv::Point2f, directions> direction;
  for (int k = 0; k < directions; ++k) {
    const double angle = std::numbers::pi * k / directions;
    direction[static_cast<std::size_t>(k)] = {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
  }
  Random random(options_.seed);
  const auto any_direction = [&] { return direction[random.below(directions)]; };
  const GradientImage& full = gradients[0];
  const float factor1 = static_cast<float>(options_.level_factor * options_.level_factor);
  const float factor2 = factor1 * factor1;
  const int border = options_.border;
  std::vector<cv::Point> picked;
  for (int y4 = border; y4 < full.rows - border; y4 += 4 * cell) {
    for (int x4 = border; x4 < full.cols - border; x4 += 4 * cell) {
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
          for (int y = y1; y < std::min(y1 + cell, full.rows - border); ++y) {
            const float* g = full.ptr<float>(y) + 4 * x1;
            const uchar* allowed = mask.empty() ? nullptr : mask[y];
            const int j = std::min(y / options_.block, squared_thresholds.rows - 1);
            for (int x = x1; x < std::min(x1 + cell, full.cols - border); ++x, g += 4) {
              if (allowed != nullptr && allowed[x] == 0) continue;
              const float threshold = squared_thresholds(j, std::min(x / options_.block, squared_thresholds.cols - 1));
              if (g[3] > threshold) best1.offer({x, y}, score(g, direction1));
              if (gradients.size() > 1 && y / 2 < gradients[1].rows && x / 2 < gradients[1].cols) {
                const float* h = gradients[1].ptr<float>(y / 2) + 4 * (x / 2);
                if (h[3] > threshold * factor1) best2.offer({x, y}, score(h, direction2));
              }
              if (gradients.size() > 2 && y / 4 < gradients[2].rows && x / 4 < gradients[2].cols) {
                const float* h = gradients[2].ptr<float>(y / 4) + 4 * (x / 4);
                if (h[3] > threshold * factor2) best4.offer({x, y}, score(h, direction4));
              }
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
  cv::Mat1f squared = thresholds(gradients[0]);
  for (float& t : squared) t *= t;
  std::vector<cv::Point> picked = pick(gradients, mask, squared, cell_);
  // The number of pixels falls about with the square of the cell's side; two corrections at most.
  for (int attempt = 0; attempt < 2; ++attempt) {
    const double ratio = static_cast<double>(picked.size()) / wanted;
    if (ratio >= 0.8 && ratio <= 1.6) break;
    const int better = std::clamp(static_cast<int>(std::lround((cell_ + 0.5) * std::sqrt(ratio) - 0.5)), 1, 64);
    if (better == cell_) break;
    cell_ = better;
    picked = pick(gradients, mask, squared, cell_);
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
