// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/window.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/reprojection.hpp"

namespace odosplat {
namespace {

double distance(const Keyframe& a, const Keyframe& b) {
  return (a.T_world_camera.translation() - b.T_world_camera.translation()).norm();
}

/// Share of the host's points, immature ones that were found included, that project into the other keyframe's image.
double visible_share(const Keyframe& host, const Keyframe& other, const Camera& camera) {
  const SE3 T_other_host = other.T_world_camera.inverse() * host.T_world_camera;
  int seen = 0;
  int all = 0;
  const auto count = [&](double u, double v, double q) {
    ++all;
    if (reproject(camera, T_other_host, u, v, q, 0.0)) ++seen;
  };
  for (const WindowPoint& point : host.points) {
    count(point.u, point.v, inverse_depth(point, camera, host.T_world_camera));
  }
  for (const ImmaturePoint& point : host.immature) {
    if (point.found > 0) count(point.u, point.v, 0.5 * (point.min_q + point.max_q));
  }
  // A keyframe that has only immature points, none found yet, is not dropped for that.
  if (all == 0) return host.immature.empty() ? 0.0 : 1.0;
  return static_cast<double>(seen) / all;
}

}  // namespace

void WindowOptions::check() const {
  require(max_keyframes >= 3 && max_keyframes <= 20, "window.max_keyframes", "3 to 20");
  require(min_visible >= 0.0 && min_visible < 1.0, "window.min_visible", "in [0, 1)");
}

void translate(Window& window, const Eigen::Vector3d& by) {
  const auto moved = [&by](const SE3& T) { return SE3(T.rotation(), T.translation() + by); };
  for (const auto& keyframe : window.keyframes) {
    keyframe->T_world_camera = moved(keyframe->T_world_camera);
    if (keyframe->T_world_tracked) keyframe->T_world_tracked = moved(*keyframe->T_world_tracked);
    for (WindowPoint& point : keyframe->points) point.plane_world.D += point.plane_world.N.dot(by);
    for (Anchor& anchor : keyframe->anchors) {
      anchor.T_world_view = moved(anchor.T_world_view);
      for (WindowPoint& point : anchor.points) point.plane_world.D += point.plane_world.N.dot(by);
    }
  }
  translate(window.prior, by);
}

int keyframe_to_drop(const Window& window, const Camera& camera, const WindowOptions& options) {
  const auto& keyframes = window.keyframes;
  const int n = static_cast<int>(keyframes.size());
  if (n < options.max_keyframes) return -1;
  const Keyframe& newest = *keyframes.back();
  for (int i = 0; i < n - 2; ++i) {
    if (visible_share(*keyframes[static_cast<std::size_t>(i)], newest, camera) < options.min_visible) return i;
  }
  int worst = 0;
  double worst_score = -1.0;
  for (int i = 0; i < n - 2; ++i) {
    const Keyframe& candidate = *keyframes[static_cast<std::size_t>(i)];
    double sum = 0.0;
    for (int j = 0; j < n; ++j) {
      if (j != i) sum += 1.0 / (1e-5 + distance(candidate, *keyframes[static_cast<std::size_t>(j)]));
    }
    const double score = std::sqrt(distance(candidate, newest)) * sum;
    if (score > worst_score) {
      worst = i;
      worst_score = score;
    }
  }
  return worst;
}

}  // namespace odosplat
