// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/light/tone_curve.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/light/brightness_splines.hpp"

namespace odosplat {
namespace {

constexpr int least_tone_points = 300;  // in view
constexpr float gray_steps = 255.0F;

CurveFitOptions curve_fit(const ToneOptions& options) {
  return {options.spans, options.sigma, options.noise, options.huber, options.explained};
}

float value_at(const ToneCurve& curve, float grey) {
  const float x = std::clamp(grey, 0.0F, 1.0F) * gray_steps;
  const std::size_t i = std::min<std::size_t>(static_cast<std::size_t>(x), curve.size() - 2);
  return curve[i] + (x - static_cast<float>(i)) * (curve[i + 1] - curve[i]);
}

}  // namespace

void ToneOptions::check() const {
  curve_fit(*this).check("tone");
  require(least > 0.0, "tone.least", "positive");
  require(min_slope > 0.0 && min_slope < 1.0, "tone.min_slope", "in (0, 1)");
}

std::optional<ToneCurve> estimate_tone(const TrackingReference& reference, const FramePyramid& target,
                                       const SE3& T_target_host, const Brightness& brightness,
                                       const ToneOptions& options) {
  if (!options.enabled) return {};
  std::vector<BrightnessSample> samples = brightness_samples(reference, target, T_target_host, brightness);
  if (samples.size() < least_tone_points) return {};
  for (BrightnessSample& sample : samples) {
    sample.curve = splines_at(sample.host, options.spans);
    sample.by_curve = -1.0;
  }
  const auto coefficients = fit_curve(samples, curve_fit(options));
  if (!coefficients) return {};
  double squares = 0.0;
  for (const BrightnessSample& sample : samples) {
    const double bend = sample.curve.value.dot(coefficients->segment<4>(sample.curve.first));
    squares += bend * bend;
  }
  const double gain = std::exp(brightness.a);
  const double size = std::sqrt(squares / static_cast<double>(samples.size()));
  if (size < options.least * gain) return {};
  ToneCurve curve;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const double grey = static_cast<double>(i) / gray_steps;
    const Splines at = splines_at(grey, options.spans);
    curve[i] = static_cast<float>(grey + at.value.dot(coefficients->segment<4>(at.first)) / gain);
    if (i > 0 && !((curve[i] - curve[i - 1]) * gray_steps >= options.min_slope)) return {};
  }
  return curve;
}

GrayImage apply_tone(const GrayImage& image, const ToneCurve& curve) {
  GrayImage out(image.rows, image.cols);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) out(y, x) = value_at(curve, image(y, x));
  }
  return out;
}

}  // namespace odosplat
