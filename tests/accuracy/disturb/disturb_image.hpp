// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"

/// What can befall an image. Pure functions; values in and out are 0..1 and clipped there, as a camera clips. The given
/// image is left as it is.
namespace odosplat::accuracy {

/// Independent normal noise on every pixel. sigma: standard deviation [grey, 0..1].
GrayImage with_noise(const GrayImage& image, double sigma, std::uint64_t seed);

/// value^gamma: below 1 brightens the dark parts. gamma > 0.
GrayImage with_gamma(const GrayImage& image, double gamma);

/// Exposed `gain` times as long: what goes beyond white stays white.
GrayImage with_gain(const GrayImage& image, double gain);

/// Gain of exposure steps at time [s] >= 0: 1, step, 1, 1 / step and so on, `period` seconds each.
double exposure_gain(double time, double step, double period);

/// Mean over a path of `length` [px] through every pixel, half of it before and half behind, along direction (u, v) of
/// any length; a direction of zero blurs along u. Beyond the border the border's value counts.
GrayImage with_motion_blur(const GrayImage& image, const Eigen::Vector2d& direction, double length);

/// Image motion [px] of the point that the camera sees in its centre at `depth` [m] when it goes from one pose to
/// another; zero if the point is then behind the camera.
Eigen::Vector2d center_motion(const Camera& camera, const SE3& T_world_from, const SE3& T_world_to, double depth);

/// Gain 1 + amplitude sin(2 pi (row / height + phase)): one wave of light over the rows, as lamps that flicker give
/// with a rolling shutter. phase in turns.
GrayImage with_rolling_gain(const GrayImage& image, double amplitude, double phase);

/// Mirrored about the upright (cv::flip's code 1) or the level axis (0).
GrayImage mirrored(const GrayImage& image, int code);

/// The image with its right half from another of the same size.
GrayImage with_right_half(const GrayImage& image, const GrayImage& other);

/// An image of one value.
GrayImage uniform_image(const Camera& camera, double value);

}  // namespace odosplat::accuracy
