// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/core/point_cloud.hpp"

namespace odosplat {

/// Reads the vertices of a PLY file: x y z needed; red green blue (integers 0..255, or floats 0..1) and nx ny nz taken
/// where there are all three of them. Points whose coordinates are not finite are dropped, with a warning that says how
/// many. Normals are brought to unit length; if one of them is zero or not finite, the cloud is read without normals.
/// Throws InputError for what read_ply refuses, a file without vertices or coordinates, and a cloud without points.
PointCloud read_point_cloud(const std::string& path);
/// The same from bytes; `name` stands for the file in errors.
PointCloud parse_point_cloud(const std::string& name, const std::string& bytes);

/// Writes binary little endian PLY: x y z float, red green blue uchar and nx ny nz float where the cloud has them.
void write_point_cloud(const std::string& path, const PointCloud& cloud);

}  // namespace odosplat
