// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/quality/sigma_calibration.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {

struct Range {
  float SigmaModel::*factor;
  float most;
};
constexpr std::array<Range, 4> ranges{Range{&SigmaModel::spread, 5.0F}, Range{&SigmaModel::slope_px, 4.0F},
                                      Range{&SigmaModel::depth_share, 0.05F}, Range{&SigmaModel::open_share, 5.0F}};
// Half a per mille of depth is the best that any measured map reached; half the spread where nothing is known of edges.
constexpr SigmaModel least_measured{0.1F, 0.05F, 5e-4F, 1e-3F};
constexpr SigmaModel least_of_surface{0.5F, 0.05F, 5e-4F, 1e-2F};

double variance_of(const SigmaSample& s, const SigmaModel& m) {
  const double spread = static_cast<double>(m.spread) * s.spread;
  const double sloped = static_cast<double>(m.slope_px) * s.slope;
  const double floor = static_cast<double>(m.depth_share) * s.depth;
  const double open = static_cast<double>(m.open_share) * s.open * s.depth;
  return spread * spread + sloped * sloped + floor * floor + open * open;
}

/// The error that the comparison shows and, at the quantile of two sigmas, the one that it cannot show.
double squared_error(const SigmaSample& s) { return s.error * s.error + 4.0 * s.shared_sigma * s.shared_sigma; }

/// Mean pinball loss of ln |error| about ln 2 sigma at the quantile of two sigmas.
double pinball_loss(const std::vector<SigmaSample>& samples, const SigmaModel& model) {
  constexpr double two_sigmas = 0.9545;
  constexpr double least_error = 1e-5;  // [m]
  double sum = 0.0;
  for (const SigmaSample& s : samples) {
    const double error = std::max(squared_error(s), least_error * least_error);
    const double above = 0.5 * std::log(error / (4.0 * variance_of(s, model)));
    sum += above * (above > 0.0 ? two_sigmas : two_sigmas - 1.0);
  }
  return sum / static_cast<double>(samples.size());
}

/// The pixel with the strongest image gradient in each cell of size `cell` [px].
std::vector<cv::Point> strongest_pixels(const ColorImage& color, int cell) {
  const GrayImage gray = to_gray(color);
  std::vector<cv::Point> pixels;
  for (int top = 0; top < gray.rows; top += cell) {
    for (int left = 0; left < gray.cols; left += cell) {
      cv::Point best(left, top);
      float most = -1.0F;
      for (int y = std::max(top, 1); y < std::min(top + cell, gray.rows - 1); ++y) {
        for (int x = std::max(left, 1); x < std::min(left + cell, gray.cols - 1); ++x) {
          const float du = gray(y, x + 1) - gray(y, x - 1);
          const float dv = gray(y + 1, x) - gray(y - 1, x);
          if (du * du + dv * dv <= most) continue;
          most = du * du + dv * dv;
          best = {x, y};
        }
      }
      pixels.push_back(best);
    }
  }
  return pixels;
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
  rasterizer.check();
}

SigmaModel fit_sigma(const std::vector<SigmaSample>& samples, const SigmaModel& least) {
  SigmaModel model;
  if (samples.empty()) return model;
  model.open_share = 0.1F;
  double best = pinball_loss(samples, model);
  for (float step = 4.0F; step > 1.03F; step = std::sqrt(step)) {
    for (bool better = true; better;) {
      better = false;
      for (const Range& range : ranges) {
        for (const float factor : {step, 1.0F / step}) {
          SigmaModel tried = model;
          tried.*range.factor = std::clamp(model.*range.factor * factor, least.*range.factor, range.most);
          const double value = pinball_loss(samples, tried);
          if (value >= best - 1e-7) continue;
          best = value;
          model = tried;
          better = true;
        }
      }
    }
  }
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
    const double cell = std::sqrt(static_cast<double>(depth.total()) / options.samples);
    for (const cv::Point& p : strongest_pixels(views.color(view), std::max(1, static_cast<int>(cell)))) {
      if (!(target(p) > 0.0F) || !(depth(p) > 0.0F) || alpha(p) < 0.5F) continue;
      const auto at = [&](const cv::Mat1f& image) { return static_cast<double>(image(p)); };
      // About the tangent of the angle between ray and normal: an error along the normal is longer along the ray.
      const double tangent = at(slope) * std::min(camera.fx, camera.fy) / at(depth);
      const double shared = by_surface ? options.shared_sigma * std::hypot(1.0, tangent) : 0.0;
      samples.push_back({at(depth) - at(target), shared, at(spread), at(slope), at(depth), 1.0 - at(alpha)});
    }
  }
  return fit_sigma(samples, measured ? least_measured : least_of_surface);
}

}  // namespace odosplat
