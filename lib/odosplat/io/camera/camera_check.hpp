// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/io/camera/camera_entries.hpp"

namespace odosplat {

/// Bounds of what a camera file can mean, for `camera.yaml` and for every other layout's camera.
namespace camera_limits {
constexpr double least_depth_scale = 1e-3;  // [units/m]
constexpr double most_depth_scale = 1e9;
constexpr double most_fps = 1e6;
// Responses are near 1 (linear) to 2.6; beyond these, all radiances are stored as two or three grey levels.
constexpr double least_gamma = 0.1;
constexpr double most_gamma = 10.0;
}  // namespace camera_limits

/// Throws InputError(key, fault) for a camera that no lens has: what Camera::check refuses, a distortion that is not
/// finite or not one-to-one over the image but for its corners (fold_radius), a gamma, depth_scale or fps (where they
/// are said) out of range.
void check_camera(const CameraFile& file);

/// The same, with the camera's file before the key: InputError(name, key, fault).
void check_camera(const std::string& name, const CameraFile& file);

/// How far from the principal point the lens model stops being one-to-one, over the lines from there to the border of
/// the (distorted) image [px]; infinite if it is one-to-one all over the image. There each pixel shows one ray; where
/// the model folds, pixels beyond show none and those before show two.
double fold_radius(const Camera& camera, const std::vector<double>& distortion);

}  // namespace odosplat
