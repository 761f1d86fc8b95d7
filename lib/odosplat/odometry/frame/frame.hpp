// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// [grey] A pixel this bright counts as clipped: its true value may be higher. The limit is below 1 because smoothing
/// darkens white pixels a little.
inline constexpr float clipped_value = 0.985F;

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
  /// Of a rolling shutter: the row taken at a share s of the readout time (Camera::time_of_row) shows what a camera at
  /// exp(s row_motion) T_camera_world sees, where T_camera_world is the image's pose. 0: all rows are taken at once.
  Vector6d row_motion = Vector6d::Zero();
  int levels() const { return static_cast<int>(gray.size()); }
};

/// Throws InputError unless the image has the camera's size.
void check_size(const Camera& camera, const GrayImage& image);

/// Levels are halved while both sides stay at least 30 px, at most 6 of them. gray is shared, not copied; its size must
/// be the camera's (InputError). smoothing [px] >= 0: standard deviation of a Gaussian that level 0 is smoothed with
/// first; it removes aliasing, which bilinear interpolation would turn into noise, and makes real and rendered images
/// more alike.
FramePyramid build_frame_pyramid(const Camera& camera, const GrayImage& gray, double smoothing = 0.0);

/// Per pixel: grey value, d/du, d/dv [1/px] by central differences, squared gradient norm. The outermost pixels have
/// gradient 0. Interleaved, so that one pixel's values lie together.
using GradientImage = cv::Mat4f;
GradientImage build_gradient(const GrayImage& gray);
std::vector<GradientImage> build_gradients(const FramePyramid& pyramid);

/// Grey value and gradient between pixels.
struct GradientSample {
  float value, gx, gy;
};

/// Bilinear; the caller makes sure that 0 <= u < cols - 1 and 0 <= v < rows - 1. data and step (in floats) are the
/// image's; they are parameters so that the innermost loop does not look them up for every pixel.
inline GradientSample sample(const float* data, std::ptrdiff_t step, float u, float v) {
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const float a = u - static_cast<float>(x);
  const float b = v - static_cast<float>(y);
  const float* r0 = data + y * step + 4 * x;
  const float* r1 = r0 + step;
  const float w11 = a * b;
  const float w10 = b - w11;
  const float w01 = a - w11;
  const float w00 = 1.0F - a - w10;
  return {w00 * r0[0] + w01 * r0[4] + w10 * r1[0] + w11 * r1[4], w00 * r0[1] + w01 * r0[5] + w10 * r1[1] + w11 * r1[5],
          w00 * r0[2] + w01 * r0[6] + w10 * r1[2] + w11 * r1[6]};
}

}  // namespace odosplat
