// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"

/// Disturbances of an image. Pure functions: the given image is not changed. Values are 0..1, and results are clipped
/// to that range as a camera does.
namespace odosplat::accuracy {

/// Independent normal noise on every pixel. sigma: standard deviation [grey, 0..1].
GrayImage with_noise(const GrayImage& image, double sigma, std::uint64_t seed);

/// value^gamma: below 1 brightens the dark parts. gamma > 0.
GrayImage with_gamma(const GrayImage& image, double gamma);

/// Multiplies all values by gain, as a longer exposure does.
GrayImage with_gain(const GrayImage& image, double gain);

/// Gain of exposure steps at time [s] >= 0: 1, step, 1, 1 / step and so on, `period` seconds each.
double exposure_gain(double time, double step, double period);

/// Mean along a line segment of `length` [px] centred on each pixel, with direction (u, v) of any length; a direction
/// of zero blurs along u. Outside the image the border's value is used.
GrayImage with_motion_blur(const GrayImage& image, const Eigen::Vector2d& direction, double length);

/// Motion in the image [px] of the point that is seen at the image centre at `depth` [m] when the camera moves from one
/// pose to another; zero if the point is then behind the camera.
Eigen::Vector2d center_motion(const Camera& camera, const SE3& T_world_from, const SE3& T_world_to, double depth);

/// Multiplies by the gain 1 + amplitude sin(2 pi (row / height + phase)): one sine wave over the rows, as flickering
/// lamps produce with a rolling shutter. phase in cycles.
GrayImage with_rolling_gain(const GrayImage& image, double amplitude, double phase);

/// Mirrored left to right (code 1, as in cv::flip) or upside down (0).
GrayImage mirrored(const GrayImage& image, int code);

/// The image with its right half replaced by that of another image of the same size.
GrayImage with_right_half(const GrayImage& image, const GrayImage& other);

/// An image of one value.
GrayImage uniform_image(const Camera& camera, double value);

}  // namespace odosplat::accuracy
