// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Where another camera sees what a pixel of its host shows.
struct Reprojection {
  Eigen::Vector2d uv;  // [px]
  double z = 0.0;      // [m] depth there
};

/// Pixel (u, v) of the host, at inverse depth q [1/m], seen by a camera of the same intrinsics. None where q is not
/// positive, behind the camera, and nearer than margin [px] to the image's edge or beyond it.
inline std::optional<Reprojection> reproject(const Camera& camera, const SE3& T_target_host, double u, double v,
                                             double q, double margin) {
  if (!(q > 0.0)) return std::nullopt;
  const Eigen::Vector3d p = T_target_host * (camera.ray(u, v) / q);
  if (!(p.z() > 1e-3)) return std::nullopt;
  const Eigen::Vector2d uv = camera.project(p);
  const bool inside = uv.x() >= margin && uv.y() >= margin && uv.x() <= camera.width - 1 - margin &&
                      uv.y() <= camera.height - 1 - margin;
  return inside ? std::make_optional<Reprojection>({uv, p.z()}) : std::nullopt;
}

}  // namespace odosplat
