// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// Gaussians from the bytes of a .splat file, the format of web viewers: 32 bytes a Gaussian, little endian, no header:
///   x y z                float32 [m]
///   standard deviations  3 x float32 [m]
///   R G B opacity        4 x uint8, over 255
///   w x y z              4 x uint8, rotation as (byte - 128) / 128
/// Gives harmonics of degree 0, unit quaternions (zero stays zero: not drawn), and opacities a quarter of a step away
/// from 0 and 1, as logits must be finite. A few Gaussians with a value that is not finite or a negative standard
/// deviation are left out (BrokenRows); a standard deviation of 0 becomes 1e-10 m. `name` stands for the file in
/// errors. InputError: a length that is no multiple of 32, many broken Gaussians, no Gaussians.
Gaussians parse_splat(const std::string& name, const std::string& bytes);

/// The bytes of that file: largest first (volume times opacity; equal ones keep their order), as viewers expect.
/// Harmonics above degree 0 cannot be stored. Bytes are rounded to the nearest and kept in range.
std::string splat_bytes(const Gaussians& gaussians);

}  // namespace odosplat
