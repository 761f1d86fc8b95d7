// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_policy.hpp"

#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"

namespace odosplat {

void KeyframePolicyOptions::check() const {
  require(translation_flow > 0.0, "keyframe.translation_flow", "positive");
  require(full_flow > 0.0, "keyframe.full_flow", "positive");
  require(log_gain > 0.0, "keyframe.log_gain", "positive");
  require(rmse_growth > 1.0, "keyframe.rmse_growth", "above 1");
  require(min_coverage >= 0.0 && min_coverage < 1.0, "keyframe.min_coverage", "in [0, 1)");
}

KeyframeScore keyframe_score(const TrackingReference& reference, const Alignment& alignment, double first_rmse,
                             const KeyframePolicyOptions& options) {
  constexpr std::size_t every = 4;
  KeyframeScore result;
  if (reference.empty()) return result;
  const Camera& camera = reference.cameras.front();
  const auto& points = reference.levels.front();
  double translation = 0.0;
  double full = 0.0;
  int n = 0;
  for (std::size_t k = 0; k < points.size(); k += every) {
    const Eigen::Vector3d p(points[k].x, points[k].y, points[k].z);
    const Eigen::Vector3d shifted = p + alignment.T_target_host.translation();
    const Eigen::Vector3d moved = alignment.T_target_host * p;
    if (!(shifted.z() > 0.01) || !(moved.z() > 0.01)) continue;
    const Eigen::Vector2d from = camera.project(p);
    translation += (camera.project(shifted) - from).squaredNorm();
    full += (camera.project(moved) - from).squaredNorm();
    ++n;
  }
  const double size = camera.width + camera.height;
  result.translation_flow = n > 0 ? std::sqrt(translation / n) : 0.0;
  result.full_flow = n > 0 ? std::sqrt(full / n) : 0.0;
  result.score = result.translation_flow / (options.translation_flow * size) +
                 result.full_flow / (options.full_flow * size) + std::abs(alignment.brightness.a) / options.log_gain;
  const bool worse = first_rmse > 0.0 && alignment.rmse > options.rmse_growth * first_rmse;
  if (worse || alignment.coverage < options.min_coverage) result.score = std::max(result.score, 1.0 + 1e-6);
  return result;
}

}  // namespace odosplat
