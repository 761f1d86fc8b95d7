// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/splat/map.hpp"

namespace odosplat {

/// Reads a map from a .splat file (see splat_file.hpp) if the path ends so, else from a PLY file as 3D Gaussian
/// Splatting programs write it (Kerbl et al. 2023), any encoding and any scalar types, properties in any order, of
/// element `vertex`:
///   x y z [m], f_dc_0..2, f_rest_0..(3K - 4) channel after channel (all of red first), opacity (logit),
///   scale_0..2 (ln m), rot_0..3 (w x y z)
/// with K = (degree + 1)^2 coefficients, degree 0..3; float or double. Other properties (nx ny nz) are ignored. Without
/// scale_2 (2D Gaussian splatting) the Gaussians are discs of 1e-6 m. An infinite opacity is 1 or 0, a scale of minus
/// infinity 1e-10 m. Gaussians with other values that are not finite, or that no device can draw (undrawable_value: a
/// rotation of length 0, e^80 m), are left out with one warning (BrokenRows).
/// Throws InputError naming the file and the fault:
/// - missing file or property,
/// - a property of whole numbers (half floats stored as ushort),
/// - a number of f_rest that fits no degree,
/// - more than a tenth of the Gaussians broken (naming the first),
/// - no Gaussians,
/// - a format that is not read (refuse_foreign_format, refuse_packed_ply),
/// - a map too far from the origin for single precision (require_near_origin),
/// - a broken field of our header (check_map_header),
/// - what read_ply refuses.
Map read_map(const std::string& path);
/// The same from memory; `name` stands for the file, its extension included.
Map parse_map(const std::string& name, const std::string& bytes);

/// Whether the name ends in .splat, in letters of either size.
bool is_splat_path(const std::string& path);

/// Whether the file holds Gaussians, by its name (.splat) or header (a PLY with colours f_dc_0), not its content. False
/// if it cannot be read; InputError for a PLY whose header is broken.
bool is_map_file(const std::string& path);

/// The header alone, Gaussians unread. InputError as read_map as far as the header shows it.
MapHeader read_map_header(const std::string& path);

/// Writes a .splat file if the path ends so (degree 0 only, quantised; a warning says what is lost, `notes` are not
/// stored), else that PLY layout, binary little endian, floats, with nx ny nz = direction of the shortest axis (unit
/// length, sign arbitrary), so that readers of point clouds find normals. The header's comments name the format's
/// version, the camera convention, and then the lines of `notes` (the training's settings; without line breaks).
/// read_map() gives back the same bits of a PLY. Written beside the path and renamed. Throws InputError if the path
/// cannot be written, or if there are no Gaussians.
void write_map(const std::string& path, const Gaussians& gaussians, const std::vector<std::string>& notes = {});
/// The same with the notes of the map's header.
void write_map(const std::string& path, const Map& map);

}  // namespace odosplat
