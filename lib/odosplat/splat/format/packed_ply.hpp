// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// Whether a PLY is packed as SuperSplat and splat-transform write it (compressed PLY): by its property packed_position.
bool is_packed_ply(const Ply& ply);

/// The Gaussians of a packed PLY: element `chunk` holds the range of 256 Gaussians each, element `vertex` four words of
/// 32 bits a Gaussian, the first field in the highest bits:
///   packed_position  11, 10, 11 bits x y z between min_ and max_ [m]
///   packed_rotation  2 bits index of the largest component of w x y z, the others in 10 bits over -1/sqrt(2)..1/sqrt(2)
///   packed_scale     11, 10, 11 bits between min_scale_ and max_scale_ [ln m]
///   packed_color     4 x 8 bits red, green, blue between min_r g b and max_ (0..1 without them), opacity
/// and element `sh`, if there is one, f_rest_0.. as bytes, -4..4, channel after channel. The axes are those of a PLY.
/// InputError naming the file: a missing element or property, a number of chunks or of harmonics that does not fit, no
/// Gaussians, many broken Gaussians.
Gaussians gaussians_from_packed_ply(const Ply& ply);

}  // namespace odosplat
