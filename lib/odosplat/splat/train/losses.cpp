// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/losses.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {

using compute::Buffer;
using compute::Range;

namespace {
constexpr int padding = 8;      // PAD of ssim.cl
constexpr int item_pixels = 8;  // of a work-item
constexpr int local_size = 16;  // work-items of a group
}  // namespace

void LossOptions::check() const { require(ssim_weight >= 0.0F && ssim_weight <= 1.0F, "ssim_weight", "in 0..1"); }

double LossValue::psnr_db() const { return std::min(100.0, -10.0 * std::log10(std::max(mse, 1e-10))); }

ImageLoss::ImageLoss(const compute::Context& context, const LossOptions& options)
    : options_((options.check(), options)),
      context_(context),
      program_(context, {"ssim.cl", "loss.cl"}),
      moments_vertical_(program_.kernel("ssim_moments_vertical", "loss")),
      ssim_horizontal_(program_.kernel("ssim_horizontal", "loss")),
      spread_vertical_(program_.kernel("ssim_spread_vertical", "loss")),
      gradient_(program_.kernel("loss_gradient", "loss")),
      rows_kernel_(program_.kernel("loss_rows", "loss")) {}

void ImageLoss::prepare(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  const int blocks = (width + item_pixels - 1) / item_pixels;
  stride_ = padding + blocks * item_pixels + padding;
  const auto map = 3 * static_cast<std::size_t>(height) * static_cast<std::size_t>(stride_);
  moments_.resize(context_, 5 * map);
  partials_.resize(context_, 3 * map);
  spread_.resize(context_, 3 * map);
  // The padding is read as zeros and never written.
  moments_.fill_zero();
  partials_.fill_zero();
  spread_.fill_zero();
  const auto values = 3 * static_cast<std::size_t>(height) * static_cast<std::size_t>(blocks);
  values_.resize(context_, 3 * values);
  rows_.resize(context_, 3 * static_cast<std::size_t>(height));
}

void ImageLoss::evaluate(const Buffer<float>& rendered, const Buffer<float>& target, int width, int height,
                         Buffer<float>& gradient) {
  prepare(width, height);
  const std::int32_t blocks = (width + item_pixels - 1) / item_pixels;
  const auto n = 3 * static_cast<std::size_t>(height) * static_cast<std::size_t>(width);
  gradient.resize(context_, n);
  const Range range =
      Range::grid(static_cast<std::size_t>(blocks) * static_cast<std::size_t>(height), 3, local_size, 1);
  moments_vertical_(range, rendered, target, moments_, width, height, stride_);
  ssim_horizontal_(range, moments_, values_, partials_, width, height, stride_);
  spread_vertical_(range, partials_, spread_, width, height, stride_);
  const float per_value = 1.0F / static_cast<float>(n);
  const std::int32_t squared = options_.color_term == ColorTerm::squared_l2 ? 1 : 0;
  gradient_(range, rendered, target, spread_, gradient, values_, width, height, stride_,
            (1.0F - options_.ssim_weight) * per_value, options_.ssim_weight * per_value, squared);
  rows_kernel_(Range::linear(3 * static_cast<std::size_t>(height), local_size), values_, rows_, blocks, height);
}

LossValue ImageLoss::value() const {
  LossValue result;
  if (height_ == 0) return result;
  const std::vector<float> rows = rows_.download();
  double sums[3] = {0.0, 0.0, 0.0};
  for (int kind = 0; kind < 3; ++kind) {
    for (int y = 0; y < height_; ++y)
      sums[kind] += static_cast<double>(
          rows[static_cast<std::size_t>(kind) * static_cast<std::size_t>(height_) + static_cast<std::size_t>(y)]);
    sums[kind] /= 3.0 * height_ * width_;
  }
  result.ssim = sums[0];
  result.l1 = sums[1];
  result.mse = sums[2];
  const double w = static_cast<double>(options_.ssim_weight);
  const double color = options_.color_term == ColorTerm::squared_l2 ? result.mse : result.l1;
  result.loss = (1.0 - w) * color + w * (1.0 - result.ssim);
  return result;
}

}  // namespace odosplat
