// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/map_places.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

void MapPlacesOptions::check() const {
  require(distance > 0.0, "places.distance", "positive");
  require(angle > 0.0, "places.angle", "positive");
  require(most >= 1, "places.most", "at least 1");
}

std::vector<SE3> thinned_places(const std::vector<SE3>& views, const MapPlacesOptions& options) {
  options.check();
  constexpr double widen = 1.25;
  double distance = options.distance;
  double angle = options.angle;
  for (;; distance *= widen, angle *= widen) {
    std::vector<SE3> kept;
    for (const SE3& view : views) {
      const bool is_near = std::any_of(kept.begin(), kept.end(), [&](const SE3& other) {
        const SE3 T_other_view = other.inverse() * view;
        return T_other_view.translation().norm() < distance && T_other_view.angle() < angle;
      });
      if (!is_near) kept.push_back(view);
      if (static_cast<int>(kept.size()) > options.most) break;
    }
    if (static_cast<int>(kept.size()) <= options.most) return kept;
  }
}

std::vector<std::string> place_lines(const std::vector<SE3>& places) {
  std::vector<std::string> lines;
  lines.reserve(places.size());
  for (const SE3& T_world_camera : places) {
    const Eigen::Vector3d& t = T_world_camera.translation();
    const Eigen::Quaterniond& q = T_world_camera.rotation();
    lines.push_back(
        formatted("training_view %.4f %.4f %.4f %.6f %.6f %.6f %.6f", t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()));
  }
  return lines;
}

std::vector<SE3> places_from_lines(const std::vector<std::string>& lines) {
  std::vector<SE3> places;
  for (const std::string& line : lines) {
    std::istringstream in(line);
    std::string word;
    if (!(in >> word) || word != "training_view") continue;
    double v[7];
    for (double& value : v) {
      if (!(in >> value) || !std::isfinite(value))
        throw InputError("training_view", "must be seven numbers, is \"" + line + "\"");
    }
    const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
    if (!(std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}) <= double{gaussian_limits::place}))
      throw InputError("training_view", "must lie within 1e7 m of the origin, is \"" + line + "\"");
    try {
      places.emplace_back(rotation_from_text(q), Eigen::Vector3d(v[0], v[1], v[2]));
    } catch (const InputError& e) {
      throw InputError("training_view", std::string(e.what()) + ", in \"" + line + "\"");
    }
  }
  return places;
}

}  // namespace odosplat
