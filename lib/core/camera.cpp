// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/camera.hpp"

#include <cmath>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

void require_size(const char* name, int size) {
  if (size < 1 || size > 32768) throw InputError(name, "must be in 1..32768, is " + std::to_string(size));
}

void require_focal(const char* name, double f) {
  if (!(f > 0.0) || !std::isfinite(f)) throw InputError(name, "must be positive, is " + std::to_string(f));
}

}  // namespace

void Camera::check() const {
  require_size("width", width);
  require_size("height", height);
  require_focal("fx", fx);
  require_focal("fy", fy);
  if (!std::isfinite(cx)) throw InputError("cx", "is not a number");
  if (!std::isfinite(cy)) throw InputError("cy", "is not a number");
}

Eigen::Matrix3d Camera::matrix() const {
  Eigen::Matrix3d K;
  K << fx, 0.0, cx, 0.0, fy, cy, 0.0, 0.0, 1.0;
  return K;
}

Camera Camera::level(int l) const {
  Camera c = *this;
  for (int i = 0; i < l; ++i) {
    c.width /= 2;
    c.height /= 2;
    c.fx *= 0.5;
    c.fy *= 0.5;
    c.cx = (c.cx + 0.5) * 0.5 - 0.5;
    c.cy = (c.cy + 0.5) * 0.5 - 0.5;
  }
  return c;
}

Camera Camera::resized(int new_width, int new_height) const {
  const double sx = static_cast<double>(new_width) / width;
  const double sy = static_cast<double>(new_height) / height;
  return {new_width, new_height, fx * sx, fy * sy, (cx + 0.5) * sx - 0.5, (cy + 0.5) * sy - 0.5};
}

}  // namespace odosplat
