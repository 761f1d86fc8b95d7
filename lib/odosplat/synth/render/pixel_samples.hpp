// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/synth/scene/scene.hpp"

namespace odosplat {

/// Offsets of n samples from a pixel's centre [px] (Roberts' R2 sequence); their mean is zero.
std::vector<Eigen::Vector2d> sample_offsets(int n);

/// Width [m], at a depth of 1 m, of the area that one of n samples represents: slightly more than the distance between
/// samples, so that no area between them is left out.
float sample_spacing(const Camera& camera, int n);

/// Sum of the radiance of a pixel's samples. hint: for Scene::closest, passed on from pixel to pixel.
Eigen::Vector3f pixel_radiance(const Scene& scene, const Camera& camera, const Eigen::Matrix3d& R_world_camera,
                               const Eigen::Vector3f& centre_world, int x, int y,
                               const std::vector<Eigen::Vector2d>& offsets, float spacing, int& hint);

}  // namespace odosplat
