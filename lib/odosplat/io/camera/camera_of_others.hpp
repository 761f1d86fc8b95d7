// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>

#include "odosplat/io/camera/camera_entries.hpp"
#include "odosplat/io/camera/camera_yaml.hpp"

namespace odosplat {

/// Reads the camera files of other programs, pinhole with OpenCV's radial and tangential distortion:
///   OpenCV, ROS   image_width, image_height, camera_matrix.data (3x3), distortion_coefficients.data, and of ROS
///                 distortion_model (plumb_bob); or the message: width, height, K and D (or k and d)
///   Kalibr        cam0: camera_model (pinhole), intrinsics [fx fy cx cy], resolution [w h], distortion_model (radtan or
///                 none), distortion_coeffs
///   EuRoC         the same at the top, distortion_model radial-tangential, distortion_coefficients; rate_hz
/// In all of them pixel centres are at integers, as here. Keys that do not describe the camera are ignored. Nothing if
/// the file is none of these. InputError for missing values, fisheye and other models, more than 5 coefficients that are
/// not 0, a skewed matrix, and a file of Kalibr with several cameras.
std::optional<CameraFile> read_camera_of_others(const CameraYaml& yaml);

}  // namespace odosplat
