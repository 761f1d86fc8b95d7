// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/io/camera/camera_entries.hpp"

namespace odosplat {

/// Limits for plausible values of a camera, for `camera.yaml` and for the cameras of all other layouts.
namespace camera_limits {
constexpr double least_depth_scale = 1e-3;  // [units/m]
constexpr double most_depth_scale = 1e9;
constexpr double most_fps = 1e6;
// Real responses range from about 1 (linear) to 2.6; beyond these limits all radiances fall on two or three grey
// levels.
constexpr double least_gamma = 0.1;
constexpr double most_gamma = 10.0;
constexpr double most_baseline = 10.0;     // [m] between colour and depth camera
constexpr double most_time_offset = 10.0;  // [s] between images and poses
}  // namespace camera_limits

/// Throws InputError(key, fault) for an implausible camera: one that Camera::check refuses, a distortion that is not
/// finite or not one-to-one over the image except for its corners (fold_radius), or a given gamma, depth_scale,
/// fps, time_offset or depth camera out of range.
void check_camera(const CameraFile& file);

/// The same, with the camera's file before the key: InputError(name, key, fault).
void check_camera(const std::string& name, const CameraFile& file);

/// The distance from the principal point [px] at which the lens model stops being one-to-one: the minimum over lines
/// from there to the border of the distorted image; infinite if it is one-to-one in the whole image. Within that radius
/// each pixel shows one ray. Where the model folds, pixels beyond the fold show no ray and those just inside show two.
double fold_radius(const Camera& camera, const std::vector<double>& distortion);

/// InputError(name, fault) if images of a rolling shutter are shown turned by one or three quarters: what was taken row
/// after row are then their columns. file: the camera's.
void check_turned_rows(const std::string& name, int quarters, const Camera& camera, const std::string& file);

}  // namespace odosplat
