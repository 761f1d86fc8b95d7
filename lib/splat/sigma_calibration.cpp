// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/sigma_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {

struct Range {
  float SigmaModel::*factor;
  float most;
};
constexpr std::array<Range, 4> ranges{Range{&SigmaModel::spread, 5.0F}, Range{&SigmaModel::slope_px, 4.0F},
                                      Range{&SigmaModel::depth_share, 0.05F}, Range{&SigmaModel::open_share, 5.0F}};
// A factor of 0 could not grow again; half the spread where nothing is known of edges.
constexpr SigmaModel least_measured{0.02F, 0.01F, 1e-4F, 1e-3F};
constexpr SigmaModel least_of_surface{0.5F, 0.05F, 3e-4F, 1e-2F};

double variance_of(const SigmaSample& s, const SigmaModel& m) {
  const double spread = static_cast<double>(m.spread) * s.spread;
  const double sloped = static_cast<double>(m.slope_px) * s.slope;
  const double floor = static_cast<double>(m.depth_share) * s.depth;
  const double open = static_cast<double>(m.open_share) * s.open * s.depth;
  return spread * spread + sloped * sloped + floor * floor + open * open;
}

/// What the comparison shows and what it cannot show.
double squared_error(const SigmaSample& s) { return s.error * s.error + s.shared_sigma * s.shared_sigma; }

/// Mean of half the clipped squared normalised error and half the logarithm of the variance.
double unlikelihood(const std::vector<SigmaSample>& samples, const SigmaModel& model, double clip) {
  double sum = 0.0;
  for (const SigmaSample& s : samples) {
    const double variance = variance_of(s, model);
    sum += 0.5 * std::log(variance) + 0.5 * std::min(squared_error(s) / variance, clip * clip);
  }
  return sum / static_cast<double>(samples.size());
}

double clipped_square(const std::vector<SigmaSample>& samples, const SigmaModel& model, double clip) {
  double sum = 0.0;
  for (const SigmaSample& s : samples) {
    const double variance = variance_of(s, model);
    sum += std::min(squared_error(s) / variance, clip * clip);
  }
  return sum / static_cast<double>(samples.size());
}

/// E[min(x^2, c^2)] of a standard normal x.
double clipped_square_of_normal(double c) {
  const double inside = std::erf(c / std::numbers::sqrt2);
  const double density = std::exp(-0.5 * c * c) / std::sqrt(2.0 * std::numbers::pi);
  return inside - 2.0 * c * density + c * c * (1.0 - inside);
}

SigmaModel scaled(SigmaModel model, float factor) {
  for (const Range& range : ranges) model.*range.factor *= factor;
  return model;
}

cv::Mat1f image_of(const compute::Buffer<float>& buffer, const Camera& camera) {
  cv::Mat1f image(camera.height, camera.width);
  buffer.download(image.ptr<float>(), image.total());
  return image;
}

}  // namespace

void SigmaCalibrationOptions::check() const {
  require(views >= 1, "views", "at least 1");
  require(samples >= 1, "samples", "at least 1");
  require(shared_sigma >= 0.0 && std::isfinite(shared_sigma), "shared_sigma", "at least 0");
  require(clip > 1.0 && std::isfinite(clip), "clip", "above 1");
  rasterizer.check();
}

SigmaModel fit_sigma(const std::vector<SigmaSample>& samples, double clip, const SigmaModel& least) {
  SigmaModel model;
  if (samples.empty()) return model;
  model.open_share = 0.1F;
  double best = unlikelihood(samples, model, clip);
  for (float step = 4.0F; step > 1.03F; step = std::sqrt(step)) {
    for (bool better = true; better;) {
      better = false;
      for (const Range& range : ranges) {
        for (const float factor : {step, 1.0F / step}) {
          SigmaModel tried = model;
          tried.*range.factor = std::clamp(model.*range.factor * factor, least.*range.factor, range.most);
          const double value = unlikelihood(samples, tried, clip);
          if (value >= best - 1e-7) continue;
          best = value;
          model = tried;
          better = true;
        }
      }
    }
  }
  // The clipped likelihood likes sigmas a little small: half-way search for the common factor.
  const double wanted = clipped_square_of_normal(clip);
  float low = 0.1F;
  float high = 10.0F;
  for (int i = 0; i < 40; ++i) {
    const float middle = std::sqrt(low * high);
    (clipped_square(samples, scaled(model, middle), clip) > wanted ? low : high) = middle;
  }
  model = scaled(model, high);
  for (const Range& range : ranges) model.*range.factor = std::max(model.*range.factor, least.*range.factor);
  return model;
}

SigmaModel calibrated_sigma(const compute::Context& context, const Gaussians& gaussians, TrainingViews& views,
                            MapView& surface, const SigmaCalibrationOptions& options) {
  options.check();
  Rasterizer rasterizer(context, options.rasterizer);
  DeviceGaussians on_device;
  on_device.upload(context, gaussians);
  RenderOutput out;
  RenderRequest request;
  request.sigma = true;
  request.depth_mode = DepthMode::surface;
  std::vector<SigmaSample> samples;
  bool measured = true;
  const int count = std::min(options.views, views.count());
  for (int k = 0; k < count; ++k) {
    const int view = static_cast<int>(static_cast<long>(k) * views.count() / count);
    const Camera camera = views.camera(view);
    const SE3 T_world_camera = views.T_world_camera(view);
    DepthImage target = views.depth(view);
    const bool by_surface = target.size() != cv::Size(camera.width, camera.height);
    if (by_surface) target = surface.render(camera, T_world_camera, {}).depth;
    measured = measured && !by_surface;
    request.sigma_model = SigmaModel::plain_spread();
    rasterizer.forward(on_device, camera, T_world_camera, request, out);
    const cv::Mat1f depth = image_of(out.depth, camera);
    const cv::Mat1f alpha = image_of(out.alpha, camera);
    const cv::Mat1f spread = image_of(out.sigma, camera);
    request.sigma_model = {0.0F, 1.0F, 0.0F, 0.0F};
    rasterizer.forward(on_device, camera, T_world_camera, request, out);
    const cv::Mat1f slope = image_of(out.sigma, camera);
    const int stride = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(depth.total()) / options.samples)));
    for (int y = stride / 2; y < depth.rows; y += stride) {
      for (int x = stride / 2; x < depth.cols; x += stride) {
        if (!(target(y, x) > 0.0F) || !(depth(y, x) > 0.0F) || alpha(y, x) < 0.5F) continue;
        const auto at = [&](const cv::Mat1f& image) { return static_cast<double>(image(y, x)); };
        // The tangent of the angle between ray and normal, about: an error across the surface is longer along the ray.
        const double tangent = at(slope) * std::min(camera.fx, camera.fy) / at(depth);
        samples.push_back({at(depth) - at(target), by_surface ? options.shared_sigma * std::hypot(1.0, tangent) : 0.0,
                           at(spread), at(slope), at(depth), 1.0 - at(alpha)});
      }
    }
  }
  return fit_sigma(samples, options.clip, measured ? least_measured : least_of_surface);
}

}  // namespace odosplat
