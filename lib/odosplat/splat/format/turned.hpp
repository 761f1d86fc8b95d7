// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

#include "odosplat/core/similarity.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// An axis of the world, by its column of positions.
enum class Axis { x, y, z };

/// Turns Gaussians by half a turn about an axis of the world, which exchanges the conventions of the formats: only signs
/// change, so that a second call gives back the same bits. A 3DGS PLY has y down and z forward (x right), SPZ y up and z
/// backward (about x), glTF y up and x left (about z).
void turn_by_half(Gaussians& gaussians, Axis axis);

/// Moves Gaussians: positions, axes, sizes, and the directions of their colours (harmonics are rotated by degree).
void move_gaussians(Gaussians& gaussians, const Similarity& T_target_source);

/// [K x K], K = sh_coefficients(degree): sh_target = matrix * sh_source for harmonics of a world that is rotated.
Eigen::MatrixXd sh_rotation(int degree, const Eigen::Matrix3d& R_target_source);

}  // namespace odosplat
