// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/core/point_cloud.hpp"
#include "odosplat/io/ply.hpp"

namespace odosplat {

/// Reads a point cloud from PLY, element `vertex`:
///   x y z         any scalar type [m]
///   red green blue   optional (also diffuse_red .. or r g b); unsigned integers over their range; floats 0..1, or
///   0..255
///                 if any is above 1
///   nx ny nz      optional; scaled to unit length. If a point has none (zero or not finite), the normals of the whole
///                 file are left out, with a warning: normals of a cloud are all or nothing.
/// Points that are not finite (the holes of organised clouds) are left out with one warning. Other properties are
/// ignored. Throws InputError: bad PLY, no x y z, a colour that is not finite or negative, no finite point at all.
PointCloud read_point_cloud(const std::string& path);
/// The same from a PLY in memory.
PointCloud point_cloud_from_ply(const Ply& ply);

/// Writes x y z as float, red green blue as uchar, nx ny nz as float, as far as the cloud has them; binary little
/// endian. An empty cloud gives a file with 0 vertices, which read_point_cloud refuses.
void write_point_cloud(const std::string& path, const PointCloud& cloud);

}  // namespace odosplat
