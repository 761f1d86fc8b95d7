// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

namespace odosplat {

/// A 32-bit hash of a lattice point and a seed.
std::uint32_t lattice_hash(int x, int y, std::uint32_t seed);

/// The same hash as a number in [0, 1).
float hash01(int x, int y, std::uint32_t seed);

/// Gradient noise on the integer lattice: smooth, mean 0, about -0.7..0.7. Source: Perlin, "Improving noise" (2002),
/// in two dimensions with gradients of all directions. It repeats every `period` (>= 1) lattice cells in x and in y,
/// so that textures made of it tile without seams. Pure function: the same bits for the same arguments.
float gradient_noise(float x, float y, int period, std::uint32_t seed);

/// Sum of `octaves` of gradient noise, each at twice the frequency and `gain` times the amplitude of the one before,
/// divided by the sum of amplitudes. period as above, for the first octave.
float fractal_noise(float x, float y, int period, int octaves, float gain, std::uint32_t seed);

}  // namespace odosplat
