// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/splat/map.hpp"

namespace odosplat {

/// Reads a map in any of these formats, recognised by the content (.splat by its name), with a warning where the name
/// says another: .splat (splat_file.hpp), SPZ, glTF with KHR_gaussian_splatting (.glb, .gltf), SOG (.sog; meta.json or
/// its folder) and the packed PLY of SuperSplat (format/spz.hpp, gltf.hpp, sog.hpp, packed_ply.hpp: axes are turned to
/// those of a PLY), else a PLY file as 3D Gaussian Splatting programs write it (Kerbl et al. 2023), any encoding and any
/// scalar types, properties in any order, of element `vertex`:
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
/// - what the readers of the other formats refuse, or a format that is not read (refuse_foreign_format),
/// - a map too far from the origin for single precision (require_near_origin),
/// - a broken field of our header (check_map_header),
/// - what read_ply refuses.
Map read_map(const std::string& path);
/// The same from memory; `name` stands for the file, its extension included. Formats that refer to other files (.gltf,
/// meta.json) are refused where they do.
Map parse_map(const std::string& name, const std::string& bytes);

/// Whether the name ends in .splat, in letters of either size.
bool is_splat_path(const std::string& path);

/// Whether the file (or folder, see read_map) holds Gaussians, by its first bytes (for a PLY: colours f_dc_0, or packed)
/// or else its name. False if it cannot be read; InputError for a PLY whose header is broken.
bool is_map_file(const std::string& path);

/// The header alone, Gaussians unread. InputError as read_map as far as the header shows it.
MapHeader read_map_header(const std::string& path);

/// Size of the file [bytes], of all files of a folder.
std::uintmax_t map_file_size(const std::string& path);

/// Writes the format that the path's extension names: .splat (degree 0 only, quantised, without header), .spz (version 4,
/// quantised), .glb, else that PLY layout, binary little endian, floats, with nx ny nz = direction of the shortest axis
/// (unit length, sign arbitrary), so that readers of point clouds find normals. The header's comments name the format's
/// version, the camera convention, and then the lines of `notes` (the training's settings; without line breaks); .spz and
/// .glb hold the same lines. read_map() gives back the same bits of a PLY. One warning says what a format loses. Written
/// beside the path and renamed. Throws InputError if the path cannot be written, for .gltf and .sog, and if there are no
/// Gaussians or the format cannot hold them.
void write_map(const std::string& path, const Gaussians& gaussians, const std::vector<std::string>& notes = {});
/// The same with the notes of the map's header.
void write_map(const std::string& path, const Map& map);

}  // namespace odosplat
