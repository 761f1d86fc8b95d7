// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/window_points.hpp"

#include <array>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr std::array<std::pair<const char*, DepthUse>, 6> words = {{{"fixed", DepthUse::fixed},
                                                                    {"pose_aware", DepthUse::pose_aware},
                                                                    {"prior", DepthUse::prior},
                                                                    {"pose_aware_prior", DepthUse::pose_aware_prior},
                                                                    {"free", DepthUse::free},
                                                                    {"interval", DepthUse::interval}}};

}  // namespace

DepthUse depth_use(const std::string& word) {
  for (const auto& [name, use] : words) {
    if (word == name) return use;
  }
  throw InputError("depth use",
                   "must be fixed, pose_aware, prior, pose_aware_prior, free or interval, is \"" + word + "\"");
}

std::string to_string(DepthUse use) {
  for (const auto& [name, value] : words) {
    if (value == use) return name;
  }
  return "";
}

void WindowPointOptions::check() const {
  require(points >= 10, "window_points.points", "at least 10");
  require(anchor_points >= 10, "window_points.anchor_points", "at least 10");
  require(gradient_weight > 0.0, "window_points.gradient_weight", "positive");
  require(min_alpha >= 0.0 && min_alpha <= 1.0, "window_points.min_alpha", "in [0, 1]");
}

std::vector<WindowPoint> make_window_points(const Camera& camera, std::span<const GradientImage> gradients,
                                            const ViewImages& view, const SE3& T_world_host, int wanted,
                                            PixelSelector& selector, const WindowPointOptions& options,
                                            const MapPlaneOptions& plane_options, DepthUse use) {
  std::vector<WindowPoint> points;
  if (view.depth.empty() || gradients.empty()) return points;
  const GradientImage& gradient = gradients[0];
  const auto min_alpha = static_cast<float>(options.min_alpha);
  cv::Mat1b mask(gradient.rows, gradient.cols);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      const bool covered = view.alpha.empty() || view.alpha(y, x) >= min_alpha;
      mask(y, x) = covered && view.depth(y, x) > 0.0F ? 1 : 0;
    }
  }
  for (const cv::Point& pixel : selector.select(gradients, mask, wanted)) {
    const auto surface = fit_surface(camera, view.depth, view.sigma, pixel.x, pixel.y, 1, plane_options);
    if (!surface) continue;
    WindowPoint point;
    point.u = static_cast<float>(pixel.x);
    point.v = static_cast<float>(pixel.y);
    point.plane_world = world_plane(surface->m_camera, T_world_host);
    point.m_host = surface->m_camera;
    point.sigma = surface->sigma;
    point.plane_in_world = use == DepthUse::pose_aware || use == DepthUse::pose_aware_prior;
    point.estimated = use != DepthUse::pose_aware && use != DepthUse::fixed;
    if (use == DepthUse::prior || use == DepthUse::pose_aware_prior) {
      point.prior_information = 1.0 / (surface->sigma * surface->sigma);
    }
    sample_pattern(gradient, pixel, options.gradient_weight, point.intensity, point.weight);
    points.push_back(point);
  }
  return points;
}

}  // namespace odosplat
