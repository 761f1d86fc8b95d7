// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <vector>

#include "odosplat/splat/edit/view_weights.hpp"
#include "odosplat/splat/map.hpp"

namespace odosplat::test {

/// Views all around in make_box_room (x 0..4, y 0..3, z 0..2.5 m), with the scene's exact depth.
const std::vector<EditView>& room_views();

/// Untrained map of that room: one flat Gaussian per voxel of 5 cm, on points of the views' depth images with `noise`
/// [m] along the rays and a jitter of the rays; seeds differ in both. The header has the views as training views, and a
/// sigma model.
Map room_map(std::uint64_t seed = 1, double noise = 0.0);

/// The same Gaussians, moved.
Map moved(Map map, const Eigen::Vector3f& by);

/// Centre of Gaussian i.
Eigen::Vector3f centre(const Gaussians& gaussians, std::size_t i);

/// A Gaussian at the end of the set: a grey ball.
void add_ball(Gaussians& gaussians, const Eigen::Vector3f& at, float size, float opacity);

}  // namespace odosplat::test
