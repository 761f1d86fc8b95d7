// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/camera/lens_model.hpp"
#include "odosplat/core/image.hpp"

namespace odosplat {

/// Removes radial and tangential lens distortion (Brown 1966, in OpenCV's form). The lens shows a point at
/// (x, y) = (X/Z, Y/Z) at
///   x' = x (1 + k1 r^2 + k2 r^4 + k3 r^6) + 2 p1 x y + p2 (r^2 + 2 x^2)
///   y' = y (1 + k1 r^2 + k2 r^4 + k3 r^6) + p1 (r^2 + 2 y^2) + 2 p2 x y
/// Images keep the camera's size, focal lengths and principal point. Pixels are 0 where the distorted image does not
/// show their ray, or where the radial polynomial is no longer increasing (it would show the same ray twice). Const
/// calls are thread safe.
class Undistorter {
 public:
  Undistorter() = default;
  /// distortion: k1 k2 p1 p2 k3, or without k3; empty: images are returned as they are.
  Undistorter(const Camera& camera, const std::vector<double>& distortion);

  bool is_identity() const { return source_.empty(); }
  /// Pixel of the distorted image that shows the ray of pixel (u, v) of the undistorted one.
  Eigen::Vector2d distort(double u, double v) const;
  /// Bilinear.
  ColorImage color(const ColorImage& distorted) const;
  /// Nearest pixel: interpolating across a depth discontinuity would make depths where there is no surface. z is
  /// unchanged.
  DepthImage depth(const DepthImage& distorted) const;
  /// Takes the depth from pixels that the distorted image does not show, of an image that is undistorted already.
  void mask_unseen(DepthImage& depth) const;

 private:
  Camera camera_;
  LensModel lens_;
  cv::Mat2f source_;  // pixel of the distorted image, (-1, -1) = not in the image
};

}  // namespace odosplat
