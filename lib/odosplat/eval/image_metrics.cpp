// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/image_metrics.hpp"

#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int window = 11;

cv::Mat1d window_means(const cv::Mat& image) {
  static const cv::Mat kernel = cv::getGaussianKernel(window, 1.5, CV_64F);
  cv::Mat1d means;
  cv::sepFilter2D(image, means, CV_64F, kernel, kernel);
  const int border = window / 2;
  return means(cv::Rect(border, border, image.cols - 2 * border, image.rows - 2 * border));
}

double channel_ssim(const cv::Mat1d& a, const cv::Mat1d& b) {
  constexpr double c1 = 0.01 * 0.01;
  constexpr double c2 = 0.03 * 0.03;
  const cv::Mat1d mean_a = window_means(a);
  const cv::Mat1d mean_b = window_means(b);
  const cv::Mat1d mean_aa = window_means(a.mul(a));
  const cv::Mat1d mean_bb = window_means(b.mul(b));
  const cv::Mat1d mean_ab = window_means(a.mul(b));
  double sum = 0.0;
  for (int y = 0; y < mean_a.rows; ++y) {
    for (int x = 0; x < mean_a.cols; ++x) {
      const double ma = mean_a(y, x);
      const double mb = mean_b(y, x);
      const double variance_a = mean_aa(y, x) - ma * ma;
      const double variance_b = mean_bb(y, x) - mb * mb;
      const double covariance = mean_ab(y, x) - ma * mb;
      sum +=
          (2.0 * ma * mb + c1) * (2.0 * covariance + c2) / ((ma * ma + mb * mb + c1) * (variance_a + variance_b + c2));
    }
  }
  return sum / static_cast<double>(mean_a.total());
}

}  // namespace

double psnr_db(const ColorImage& a, const ColorImage& b) {
  if (a.size() != b.size() || a.empty()) throw InputError("images", "are empty or differ in size");
  double squares = 0.0;
  for (int y = 0; y < a.rows; ++y) {
    for (int x = 0; x < a.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        const double d = static_cast<double>(a(y, x)[c]) - static_cast<double>(b(y, x)[c]);
        squares += d * d;
      }
    }
  }
  if (squares == 0.0) return std::numeric_limits<double>::infinity();
  return -10.0 * std::log10(squares / (3.0 * static_cast<double>(a.total())));
}

double ssim(const ColorImage& a, const ColorImage& b) {
  if (a.size() != b.size()) throw InputError("images", "differ in size");
  if (a.rows < window || a.cols < window) throw InputError("images", "are smaller than the 11x11 window of SSIM");
  std::vector<cv::Mat> channels_a;
  std::vector<cv::Mat> channels_b;
  cv::split(a, channels_a);
  cv::split(b, channels_b);
  double sum = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    cv::Mat1d channel_a;
    cv::Mat1d channel_b;
    channels_a[c].convertTo(channel_a, CV_64F);
    channels_b[c].convertTo(channel_b, CV_64F);
    sum += channel_ssim(channel_a, channel_b);
  }
  return sum / 3.0;
}

}  // namespace odosplat
