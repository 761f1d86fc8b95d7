// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/splat/format/foreign_map.hpp"

namespace odosplat {

/// SPZ (Niantic, github.com/nianticlabs/spz), versions 1 to 4, little endian. Versions 1 to 3 are one gzip stream of a
/// header of 16 bytes and the attributes, version 4 a header of 32 bytes, extensions (type, length, content), a table
/// of sizes, and a zstd stream an attribute:
///   positions   3 x 24 bits, fixed point with the header's number of fractional bits (version 1: half floats) [m]
///   alphas      opacity * 255
///   colours     (0.5 + 0.15 sh) * 255 for the coefficient of degree 0
///   scales      16 * (ln m + 10)
///   rotations   versions 1 and 2: x y z as (v + 1) * 127.5, w >= 0; later: index of the largest component of x y z w in
///               2 bits, the others in 10 bits, sign and magnitude over 1/sqrt(2)
///   harmonics   128 * (sh + 1), coefficient after coefficient, R G B inside
/// The axes are x right, y up, z backward: half a turn about x from those of a PLY.

/// The map in such a file. Harmonics of degree 4 are left out, with a warning. A file that says that it was trained with
/// antialiasing gives the line "compensated 1", an extension of ours the lines of the header. `name` stands for the file
/// in errors. InputError: damaged or cut off, another version, a degree above 4, sizes that do not fit the number of
/// Gaussians or that the file cannot hold, no Gaussians, many broken Gaussians.
ForeignMap parse_spz(const std::string& name, const std::string& bytes);

/// Its lines alone, without the Gaussians.
std::vector<std::string> spz_lines(const std::string& name, const std::string& bytes);

/// A file of version 4 with `lines` in an extension. Positions are rounded to 2^-12 m, more finely if no coordinate
/// reaches 4 m, and more coarsely if one is above 2 km; harmonics above degree 0 to 1/128 in -1..127/128; ln sizes to
/// 1/16 in -10..5.94. What is outside is clamped. InputError naming the file: a coordinate above 4e6 m, more Gaussians
/// than fit into 32 bits.
std::string spz_bytes(const std::string& name, Gaussians gaussians, const std::vector<std::string>& lines);

}  // namespace odosplat
