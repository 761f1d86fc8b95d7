// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/light/row_gain.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/light/brightness_splines.hpp"

namespace odosplat {
namespace {

constexpr int least_row_points = 100;  // in view

CurveFitOptions curve_fit(const RowGainOptions& options) {
  return {options.spans, options.sigma, options.noise, options.huber, options.explained};
}

/// The splines at every row of an image, 1 added, divided by the mean.
RowGain curve(const Eigen::VectorXd& coefficients, int spans, int rows) {
  RowGain gain(static_cast<std::size_t>(rows));
  for (std::size_t v = 0; v < gain.size(); ++v) {
    const Splines at = splines_at((static_cast<double>(v) + 0.5) / rows, spans);
    const double value = 1.0 + at.value.dot(coefficients.segment<4>(at.first));
    gain[v] = static_cast<float>(std::clamp(value, 0.3, 3.0));
  }
  const double mean = std::accumulate(gain.begin(), gain.end(), 0.0) / rows;
  for (float& value : gain) value /= static_cast<float>(mean);
  return gain;
}

}  // namespace

void RowGainOptions::check() const {
  curve_fit(*this).check("row_gain");
  require(least > 0.0, "row_gain.least", "positive");
  require(same >= 0.0, "row_gain.same", "at least 0");
}

RowGain estimate_row_gain(const TrackingReference& reference, const FramePyramid& target, const SE3& T_target_host,
                          const Brightness& brightness, const RowGainOptions& options) {
  std::vector<BrightnessSample> samples = brightness_samples(reference, target, T_target_host, brightness);
  if (samples.size() < least_row_points) return {};
  for (BrightnessSample& sample : samples) {
    sample.curve = splines_at(sample.height, options.spans);
    sample.by_curve = -sample.expected;
  }
  const auto coefficients = fit_curve(samples, curve_fit(options));
  if (!coefficients) return {};
  RowGain gain = curve(*coefficients, options.spans, target.gray.front().rows);
  if (unevenness(gain) < options.least) gain.clear();
  return gain;
}

double unevenness(const RowGain& gain) {
  double squares = 0.0;
  for (const float value : gain) squares += (value - 1.0) * (value - 1.0);
  return gain.empty() ? 0.0 : std::sqrt(squares / static_cast<double>(gain.size()));
}

FramePyramid divide_rows(const FramePyramid& pyramid, const RowGain& gain) {
  if (gain.empty()) return pyramid;
  FramePyramid divided = pyramid;
  RowGain of_level = gain;
  for (GrayImage& image : divided.gray) {
    image = image.clone();
    for (int y = 0; y < image.rows; ++y) {
      const float factor = 1.0F / of_level[static_cast<std::size_t>(y)];
      for (int x = 0; x < image.cols; ++x) image(y, x) *= factor;
    }
    const std::size_t half = of_level.size() / 2;
    for (std::size_t y = 0; y < half; ++y) of_level[y] = 0.5F * (of_level[2 * y] + of_level[2 * y + 1]);
    of_level.resize(half);
  }
  return divided;
}

}  // namespace odosplat
