// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <cmath>
#include <numeric>

#include "kernels/constants.h"
#include "tests/splat/reference/raster_reference.hpp"

namespace odosplat::reference {
namespace {

constexpr auto min_alpha = static_cast<double>(MIN_ALPHA);
constexpr auto max_alpha = static_cast<double>(MAX_ALPHA);
constexpr auto min_transmittance = static_cast<double>(MIN_TRANSMITTANCE);
constexpr auto min_ratio = static_cast<double>(MIN_PLANE_RATIO);
constexpr auto surface_spread = static_cast<double>(SURFACE_SPREAD);

// Values of a Gaussian at a pixel.
struct Sample {
  double dx, dy, alpha, ratio, z;
};

Sample sample_at(const Splat& s, double x, double y) {
  Sample at{};
  at.dx = x - s.value[0];
  at.dy = y - s.value[1];
  const double q = s.value[2] * at.dx * at.dx + 2.0 * s.value[3] * at.dx * at.dy + s.value[4] * at.dy * at.dy;
  at.alpha = std::exp(s.value[5] - 0.5 * q);
  at.ratio = 1.0 - s.value[7] * at.dx - s.value[8] * at.dy;
  at.z = s.value[6] / at.ratio;
  return at;
}

std::vector<std::size_t> near_to_far(const std::vector<Splat>& splats) {
  std::vector<std::size_t> order(splats.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // Sorted in float32 as on the device: Gaussians with equal keys keep their order.
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return static_cast<float>(splats[a].far) < static_cast<float>(splats[b].far);
  });
  return order;
}

double relative(double value, double threshold) { return std::abs(value / threshold - 1.0); }

// Decides which Gaussians contribute to the pixel; returns the smallest margin.
double decide(const std::vector<Splat>& splats, const std::vector<std::size_t>& order, double x, double y,
              std::vector<Contribution>& pixel) {
  double margin = 1.0;
  double T = 1.0;
  for (std::size_t g : order) {
    if (!splats[g].drawn) continue;
    const Sample at = sample_at(splats[g], x, y);
    margin = std::min({margin, relative(at.alpha, min_alpha)});
    if (at.alpha < min_alpha) continue;
    Contribution c;
    c.gaussian = g;
    c.capped = at.alpha > max_alpha;
    c.bounded = at.ratio < min_ratio;
    const double after = T * (1.0 - std::min(at.alpha, max_alpha));
    c.median = T >= 0.5 && after < 0.5;
    margin = std::min({margin, relative(at.alpha, max_alpha), relative(at.ratio, min_ratio), relative(after, 0.5),
                       relative(after, min_transmittance)});
    pixel.push_back(c);
    T = after;
    if (T < min_transmittance) break;
  }
  return margin;
}

double alpha_of(const Sample& at, const Contribution& c) { return c.capped ? max_alpha : at.alpha; }
double depth_of(const Splat& s, const Sample& at, const Contribution& c) {
  return c.bounded ? s.value[6] / min_ratio : at.z;
}

}  // namespace

Images composite(const std::vector<Splat>& splats, const Camera& camera, const RenderRequest& request,
                 const Decisions* frozen, Decisions* made) {
  Images out;
  out.width = camera.width;
  out.height = camera.height;
  const auto pixels = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  out.color.resize(3 * pixels);
  out.depth.resize(pixels);
  out.alpha.resize(pixels);
  out.sigma.resize(pixels);
  out.margin.resize(pixels, 1.0);
  if (made != nullptr) made->assign(pixels, {});
  const std::vector<std::size_t> order = near_to_far(splats);
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto x = static_cast<double>(i % static_cast<std::size_t>(camera.width));
    const auto y = static_cast<double>(i / static_cast<std::size_t>(camera.width));
    std::vector<Contribution> pixel;
    if (frozen != nullptr) {
      pixel = (*frozen)[i];
    } else {
      out.margin[i] = decide(splats, order, x, y, pixel);
    }
    double T = 1.0, weighted = 0.0, median = 0.0, sloped = 0.0;
    std::vector<std::pair<double, double>> weights;  // w, z
    for (const Contribution& c : pixel) {
      const Splat& s = splats[c.gaussian];
      const Sample at = sample_at(s, x, y);
      const double w = T * alpha_of(at, c);
      const double z = depth_of(s, at, c);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        out.color[channel * pixels + i] += w * s.value[9 + channel];
      }
      weighted += w * z;
      sloped += w * s.value[6] * std::hypot(s.value[7], s.value[8]);
      if (c.median) median = z;
      weights.emplace_back(w, z);
      T *= 1.0 - alpha_of(at, c);
    }
    out.alpha[i] = 1.0 - T;
    if (!pixel.empty()) {
      const double mean = weighted / out.alpha[i];
      double square = 0.0;
      for (const auto& [w, z] : weights) square += w * (z - mean) * (z - mean);
      const double spread = std::sqrt(square / out.alpha[i]);
      const double mixed = spread / (surface_spread * mean);
      if (request.depth_mode == DepthMode::surface) out.margin[i] = std::min(out.margin[i], std::abs(mixed - 1.0));
      switch (request.depth_mode) {
        case DepthMode::expected:
          out.depth[i] = mean;
          break;
        case DepthMode::median:
          out.depth[i] = median;
          break;
        case DepthMode::blended:
          out.depth[i] = weighted;
          break;
        case DepthMode::surface:
          out.depth[i] = mixed > 1.0 && median > 0.0 ? median : mean;
          break;
      }
      const SigmaModel& model = request.sigma_model;
      const auto factor = [](float f) { return static_cast<double>(f); };
      out.sigma[i] =
          std::hypot(std::hypot(factor(model.spread) * spread, factor(model.slope_px) * sloped / out.alpha[i]),
                     std::hypot(factor(model.depth_share) * out.depth[i], factor(model.open_share) * T * out.depth[i]));
    }
    if (made != nullptr) (*made)[i] = std::move(pixel);
  }
  return out;
}

std::vector<std::array<double, splat_values>> composite_backward(const std::vector<Splat>& splats, const Camera& camera,
                                                                 const RenderRequest& request,
                                                                 const Decisions& decisions,
                                                                 const ImageGradients& given) {
  std::vector<std::array<double, splat_values>> out(splats.size());
  const std::size_t pixels = decisions.size();
  for (std::size_t i = 0; i < pixels; ++i) {
    const auto x = static_cast<double>(i % static_cast<std::size_t>(camera.width));
    const auto y = static_cast<double>(i / static_cast<std::size_t>(camera.width));
    const std::vector<Contribution>& pixel = decisions[i];
    if (pixel.empty()) continue;
    std::vector<double> before(pixel.size() + 1, 1.0);
    double weighted = 0.0;
    for (std::size_t k = 0; k < pixel.size(); ++k) {
      const Splat& s = splats[pixel[k].gaussian];
      const Sample at = sample_at(s, x, y);
      const double alpha = alpha_of(at, pixel[k]);
      weighted += before[k] * alpha * depth_of(s, at, pixel[k]);
      before[k + 1] = before[k] * (1.0 - alpha);
    }
    const double covered = 1.0 - before.back();
    // The images are sums over w of 1 (alpha), depth and colour; expected depth is the quotient of two of them.
    double d_one = given.alpha.empty() ? 0.0 : given.alpha[i];
    double d_weighted = 0.0, d_median = 0.0;
    if (!given.depth.empty()) {
      if (request.depth_mode == DepthMode::expected) {
        d_weighted = given.depth[i] / covered;
        d_one -= given.depth[i] * weighted / (covered * covered);
      } else if (request.depth_mode == DepthMode::median) {
        d_median = given.depth[i];
      } else {
        d_weighted = given.depth[i];
      }
    }
    double behind = 0.0;  // value composited from the Gaussians behind
    for (std::size_t k = pixel.size(); k-- > 0;) {
      const Contribution& c = pixel[k];
      const Splat& s = splats[c.gaussian];
      std::array<double, splat_values>& d = out[c.gaussian];
      const Sample at = sample_at(s, x, y);
      const double alpha = alpha_of(at, c), T = before[k], w = T * alpha, z = depth_of(s, at, c);
      double value = d_one + d_weighted * z;
      for (std::size_t channel = 0; channel < 3; ++channel) {
        if (given.color.empty()) continue;
        const double g = given.color[channel * pixels + i];
        value += g * s.value[9 + channel];
        d[9 + channel] += w * g;
      }
      const double d_z = w * d_weighted + (c.median ? d_median : 0.0);
      if (c.bounded) {
        d[6] += d_z / min_ratio;
      } else {
        const double d_ratio = -d_z * at.z / at.ratio;
        d[6] += d_z / at.ratio;
        d[7] -= d_ratio * at.dx;
        d[8] -= d_ratio * at.dy;
        d[0] += d_ratio * s.value[7];
        d[1] += d_ratio * s.value[8];
      }
      if (!c.capped) {
        const double d_exponent = alpha * (T * value - T * behind);  // dL/d ln alpha
        d[5] += d_exponent;
        d[2] -= 0.5 * d_exponent * at.dx * at.dx;
        d[3] -= d_exponent * at.dx * at.dy;
        d[4] -= 0.5 * d_exponent * at.dy * at.dy;
        d[0] += d_exponent * (s.value[2] * at.dx + s.value[3] * at.dy);
        d[1] += d_exponent * (s.value[3] * at.dx + s.value[4] * at.dy);
      }
      behind = alpha * value + (1.0 - alpha) * behind;
    }
  }
  return out;
}

}  // namespace odosplat::reference
