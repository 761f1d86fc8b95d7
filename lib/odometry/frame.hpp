// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "odosplat/core/camera.hpp"
#include "odosplat/core/image.hpp"

namespace odosplat {

/// Affine brightness of a frame: I_frame = e^a L + b, where L is what a camera of neutral exposure would have seen.
/// Seen from another frame: I_target = b_target + e^(a_target - a_host) (I_host - b_host).
/// Source: Engel, Koltun, Cremers 2018 (DSO), without exposure times. a [-], b [grey, 0..1].
struct Brightness {
  double a = 0.0;
  double b = 0.0;
};

/// The brightness of `target` relative to `host`: I_target = e^a I_host + b with the a and b returned here.
Brightness relative_brightness(const Brightness& target, const Brightness& host);
/// The inverse step: brightness of the target, given its host's and the relative one.
Brightness compose_brightness(const Brightness& relative, const Brightness& host);

/// Grey images from full size (level 0) down to about 40x30, each with its camera.
struct FramePyramid {
  std::vector<Camera> cameras;
  std::vector<GrayImage> gray;
  int levels() const { return static_cast<int>(gray.size()); }
};

/// Levels are halved while both sides stay at least 30 px, at most 6 of them. gray is shared, not copied; its size must
/// be the camera's (InputError).
FramePyramid build_frame_pyramid(const Camera& camera, const GrayImage& gray);

/// Per pixel: grey value, d/du, d/dv [1/px] by central differences, squared gradient norm. The outermost pixels have
/// gradient 0. Four channels, so that one pixel is one SIMD register.
using GradientImage = cv::Mat4f;
GradientImage build_gradient(const GrayImage& gray);
std::vector<GradientImage> build_gradients(const FramePyramid& pyramid);

/// Bilinear value of all four channels; the caller makes sure that 0 <= u < cols - 1 and 0 <= v < rows - 1.
inline Eigen::Array4f sample(const GradientImage& image, float u, float v) {
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const float a = u - static_cast<float>(x);
  const float b = v - static_cast<float>(y);
  using Pixel = Eigen::Map<const Eigen::Array4f>;
  const float* r0 = image.ptr<float>(y) + 4 * x;
  const float* r1 = image.ptr<float>(y + 1) + 4 * x;
  const float ab = a * b;
  return (1.0F - a - b + ab) * Pixel(r0) + (a - ab) * Pixel(r0 + 4) + (b - ab) * Pixel(r1) + ab * Pixel(r1 + 4);
}

}  // namespace odosplat
