// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/splat/format/foreign_map.hpp"

namespace odosplat {

/// glTF 2.0 with KHR_gaussian_splatting (Khronos, ratified 2026): point primitives with the attributes POSITION and
/// KHR_gaussian_splatting:ROTATION (x y z w), SCALE (standard deviations), OPACITY (0..1) and SH_DEGREE_l_COEF_n, or an
/// SPZ file in a buffer view (KHR_gaussian_splatting_compression_spz_2). The axes are x left, y up, z forward: half a
/// turn about z from those of a PLY.

/// The Gaussians of the default scene (of all meshes if there are no scenes), moved by their nodes; one file may hold
/// several primitives. `bytes`: binary (.glb) or JSON (.gltf), whose buffers are read by `read_sibling` or are in it as
/// base64. A file of ours gives the lines of the header (extras of the mesh); if nodes move the map, those of its places
/// and its quality are left out, with a warning. Scales below 0 show a file of the extension's drafts, which stored their
/// logarithms; it is read so, with a warning. The sorting method is no evidence of how a map was trained, since the
/// format has no other, and is not taken over.
/// `name` stands for the file in errors. InputError naming the place in the JSON: damaged or cut off, an index, a size or
/// a type that the format does not allow, sparse accessors, a node that shears or mirrors, no Gaussians, many broken
/// Gaussians.
ForeignMap parse_gltf(const std::string& name, const std::string& bytes, const ReadSibling& read_sibling);

/// Its lines alone, without the Gaussians.
std::vector<std::string> gltf_lines(const std::string& name, const std::string& bytes);

/// A binary file: one mesh, with `lines` in its extras, and COLOR_0 for viewers that draw points only. Values are
/// floats. InputError naming the file if it would be larger than 4 GiB, the format's limit.
std::string glb_bytes(const std::string& name, Gaussians gaussians, const std::vector<std::string>& lines);

}  // namespace odosplat
