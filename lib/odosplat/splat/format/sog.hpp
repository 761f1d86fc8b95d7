// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/splat/format/foreign_map.hpp"

namespace odosplat {

/// SOG (PlayCanvas), version 2, and version 1, which has no version number: meta.json and lossless WebP images, of which
/// pixel i, row after row, belongs to Gaussian i:
///   means     low and high byte of 16 bits between mins and maxs of sign(p) ln(1 + |p|) [m]
///   quats     the components of w x y z but the largest, -1/sqrt(2)..1/sqrt(2), and 252 + index of the largest in alpha
///   scales    ln m, by a codebook of 256 values (version 1: between mins and maxs)
///   sh0       coefficient of degree 0 by a codebook, opacity * 255 in alpha (version 1: all between mins and maxs, the
///             opacity as logit)
///   shN       a number of 16 bits of one of up to 65536 sets of harmonics, whose coefficients are in an image of their
///             own, 64 sets a row, by a codebook (version 1: between mins and maxs)
/// The axes are those of a PLY.

/// The map in an archive (.sog, ZIP) or in a meta.json whose images `read_sibling` reads. "antialias" gives the line
/// "compensated 1"; there is no place for others. `name` stands for the file in errors. InputError: damaged or cut off,
/// another version, a value that is missing, images that are lossy, too small for the number of Gaussians or much
/// larger, no Gaussians, many broken Gaussians.
ForeignMap parse_sog(const std::string& name, const std::string& bytes, const ReadSibling& read_sibling);

/// Its lines alone, without the Gaussians.
std::vector<std::string> sog_lines(const std::string& name, const std::string& bytes);

}  // namespace odosplat
