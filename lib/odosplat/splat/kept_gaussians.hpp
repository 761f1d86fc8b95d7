// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// The Gaussians i with keep[i], in their order. Throws InputError if keep has another size than the set.
Gaussians kept_gaussians(const Gaussians& gaussians, const std::vector<bool>& keep);

/// The same Gaussians with spherical harmonics of a degree, which must not be below theirs: the coefficients added are
/// zero, so that they look the same from everywhere. InputError for a lower degree or one above 3.
Gaussians with_sh_degree(const Gaussians& gaussians, int degree);

/// Appends `more` to `gaussians`. Both get the higher of the two degrees.
void append_gaussians(Gaussians& gaussians, const Gaussians& more);

}  // namespace odosplat
