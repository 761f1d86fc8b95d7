// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// Reads a whole point cloud (PLY, PCD, LAS or text, as described at scan_cloud) into memory. If any point has no
/// normal (zero or not finite), all normals of the file are left out, with a warning, because a PointCloud has normals
/// for all points or for none. Throws InputError as scan_cloud does, and for a cloud so far from the origin that a
/// coordinate would move by more than 1 mm when rounded to float (survey coordinates; `odosplat cloud --origin` shifts
/// them).
PointCloud read_point_cloud(const std::string& path);
/// The same from memory; `name` stands for the file, its extension included.
PointCloud parse_point_cloud(const std::string& name, const std::string& bytes);

/// Writes a PLY file with x y z as float, and red green blue as uchar and nx ny nz as float if the cloud has them;
/// binary little endian. An empty cloud gives a file with 0 vertices, which read_point_cloud refuses. The header's
/// comments give the unit (metres), followed by the lines of `notes` (without line breaks).
void write_point_cloud(const std::string& path, const PointCloud& cloud, const std::vector<std::string>& notes = {});

}  // namespace odosplat
