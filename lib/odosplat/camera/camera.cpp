// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/camera/camera.hpp"

#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

void require_size(const char* name, int size) {
  if (size < 1 || size > 32768) throw InputError(name, "must be in 1..32768, is " + std::to_string(size));
}

// A focal length of a thousandth of the image size is a field of view of 179.9 degrees; with 1e6 px the largest
// image (32768 px) has one of 2 degrees.
constexpr double least_focal_share = 1e-3;
constexpr double most_focal = 1e6;

void require_focal(const char* name, double f, int size) {
  if (!(f > 0.0)) throw InputError(name, "must be positive, is " + number_text(f));
  const double least = least_focal_share * size;
  if (f >= least && f <= most_focal) return;
  throw InputError(name, "must be in " + number_text(least) + ".." + number_text(most_focal) + " for an image of " +
                             std::to_string(size) + " px, is " + number_text(f));
}

// An image may be a crop of the largest allowed one (32768 px), so its principal point can lie that far outside.
void require_center(const char* name, double c, int size) {
  if (c >= -32768.0 && c <= size + 32768.0) return;
  throw InputError(name, "must be within 32768 px of the image, is " + number_text(c));
}

}  // namespace

void Camera::check() const {
  require_size("width", width);
  require_size("height", height);
  require_focal("fx", fx, width);
  require_focal("fy", fy, height);
  require_center("cx", cx, width);
  require_center("cy", cy, height);
  if (!(readout >= -1.0 && readout <= 1.0)) {
    throw InputError("readout", "must be at most 1 s (line_time times height), is " + number_text(readout));
  }
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
  return {new_width, new_height, fx * sx, fy * sy, (cx + 0.5) * sx - 0.5, (cy + 0.5) * sy - 0.5, readout};
}

}  // namespace odosplat
