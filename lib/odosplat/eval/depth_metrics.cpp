// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/depth_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int bins_a_decade = 2000;
constexpr double least_decade = -6.0;  // log10 of 1 um
constexpr int decades = 8;

}  // namespace

DepthMetrics::DepthMetrics() : bins_(static_cast<std::size_t>(bins_a_decade * decades), 0) {}

void DepthMetrics::add(const DepthImage& estimate, const DepthImage& truth, const cv::Mat1b& mask,
                       const cv::Mat1f& sigma) {
  if (estimate.size() != truth.size() || (!mask.empty() && mask.size() != truth.size()) ||
      (!sigma.empty() && sigma.size() != truth.size())) {
    throw InputError("depth images", "differ in size");
  }
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      if (!(truth(y, x) > 0.0F) || (!mask.empty() && mask(y, x) == 0)) continue;
      ++pixels_;
      if (!(estimate(y, x) > 0.0F) || !std::isfinite(estimate(y, x))) continue;
      ++valid_;
      const double error = static_cast<double>(estimate(y, x)) - static_cast<double>(truth(y, x));
      if (!sigma.empty() && sigma(y, x) > 0.0F) {
        ++with_sigma_;
        for (int k = 0; k < 3; ++k)
          within_[k] += std::abs(error) <= (k + 1.0) * static_cast<double>(sigma(y, x)) ? 1U : 0U;
      }
      sum_ += error;
      squares_ += error * error;
      const double place = (std::log10(std::max(std::abs(error), 1e-12)) - least_decade) * bins_a_decade;
      const double last = static_cast<double>(bins_.size() - 1);
      ++bins_[static_cast<std::size_t>(std::clamp(place, 0.0, last))];
    }
  }
}

double DepthMetrics::quantile(double share) const {
  const double wanted = share * static_cast<double>(valid_);
  double below = 0.0;
  for (std::size_t i = 0; i < bins_.size(); ++i) {
    const auto here = static_cast<double>(bins_[i]);
    if (below + here >= wanted && here > 0.0) {
      if (i == 0) return 0.0;  // less than a micrometre
      const double place = static_cast<double>(i) + (wanted - below) / here;
      return std::pow(10.0, least_decade + place / bins_a_decade);
    }
    below += here;
  }
  return 0.0;
}

DepthErrors DepthMetrics::result() const {
  DepthErrors errors;
  errors.pixels = pixels_;
  if (pixels_ == 0) return errors;
  errors.valid_share = static_cast<double>(valid_) / static_cast<double>(pixels_);
  if (valid_ == 0) return errors;
  errors.mean_m = sum_ / static_cast<double>(valid_);
  errors.rmse_m = std::sqrt(squares_ / static_cast<double>(valid_));
  errors.median_abs_m = quantile(0.5);
  errors.p90_m = quantile(0.9);
  errors.with_sigma = with_sigma_;
  for (int k = 0; k < 3 && with_sigma_ > 0; ++k)
    errors.within_sigmas[k] = static_cast<double>(within_[k]) / static_cast<double>(with_sigma_);
  return errors;
}

cv::Mat1b depth_edge_mask(const DepthImage& depth, int radius, double min_step) {
  require(radius >= 0, "radius", "at least 0 [px]");
  require(min_step > 0.0, "min_step", "positive");
  cv::Mat1b edges(depth.size(), 0);
  const auto mark = [&](int y0, int x0, int y1, int x1) {
    const float a = depth(y0, x0);
    const float b = depth(y1, x1);
    if (!(a > 0.0F) || !(b > 0.0F)) return;
    if (std::abs(a - b) <= static_cast<float>(min_step) * std::min(a, b)) return;
    edges(y0, x0) = 255;
    edges(y1, x1) = 255;
  };
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (x + 1 < depth.cols) mark(y, x, y, x + 1);
      if (y + 1 < depth.rows) mark(y, x, y + 1, x);
    }
  }
  if (radius == 0 || edges.empty()) return edges;
  // The pixels on both sides of an edge, which have distance 1, are already marked.
  cv::Mat1b wide;
  const int reach = radius - 1;
  cv::dilate(edges, wide, cv::getStructuringElement(cv::MORPH_RECT, {2 * reach + 1, 2 * reach + 1}));
  return wide;
}

}  // namespace odosplat
