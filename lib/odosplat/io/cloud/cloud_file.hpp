// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// Reads a point cloud from PLY, PCD, LAS or text as scan_cloud says, the whole of it into memory. If a point has no
/// normal (zero or not finite), the normals of the whole file are left out, with a warning: normals of a cloud are all
/// or nothing. Throws InputError as scan_cloud says, and for a cloud so far from the origin that a coordinate would
/// move by more than 1 mm when it is rounded to float (survey coordinates; `odosplat cloud --origin` moves them).
PointCloud read_point_cloud(const std::string& path);
/// The same from memory; `name` stands for the file, its extension included.
PointCloud parse_point_cloud(const std::string& name, const std::string& bytes);

/// Writes x y z as float, red green blue as uchar, nx ny nz as float, as far as the cloud has them; binary little
/// endian. An empty cloud gives a file with 0 vertices, which read_point_cloud refuses. The header's comments say
/// metres, and then the lines of `notes` (without line breaks).
void write_point_cloud(const std::string& path, const PointCloud& cloud, const std::vector<std::string>& notes = {});

}  // namespace odosplat
