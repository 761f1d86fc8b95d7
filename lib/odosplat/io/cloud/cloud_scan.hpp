// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>

#include "odosplat/core/cloud_batch.hpp"

namespace odosplat {

/// Receives a batch; an exception ends the scan.
using CloudSink = std::function<void(const CloudBatch&)>;

/// Reads a point cloud of any size and passes it to `sink` in batches of at most 65536 points in the order of the file;
/// only a few batches are in memory at a time. A batch has colours and normals if the file has them.
///
/// The format is recognised by the first bytes (PLY, PCD, LAS), else by the extension (.ply .pcd .las .xyz .csv .txt
/// .asc .pts):
///   PLY   ascii and binary of both byte orders; element `vertex`, x y z of any scalar type; optional red green blue
///         (diffuse_red .., r g b): 0..255; if any is above 255 and the type is wider than a byte, 0..65535; floats
///         0..1 if none is above 1; optional nx ny nz; other properties, lists and elements are skipped.
///   PCD   ascii, binary, binary_compressed; x y z of any SIZE and TYPE; optional rgb or rgba packed into 4 bytes, or r
///         g b as in PLY; optional normal_x normal_y normal_z (nx ny nz); other fields and COUNTs are skipped, and so
///         is VIEWPOINT.
///   LAS   1.0 to 1.4, point formats 0 to 10, uncompressed: scale and offset are applied; colours, where the format has
///         them, are divided by 65535, or by 255 if no value is larger; if all are black, there are none. Points marked
///         as withheld are left out. LAZ is refused.
///   text  one point per line, separated by blanks, commas or semicolons (determined by the first point's line); # and
///         // start comments; a first line may name the columns (x y z, r g b or red green blue, nx ny nz or normal_x
///         ..; others, such as intensity, are ignored). Without names: 3 columns are x y z; 4: x y z and an ignored
///         one; 6: x y z and r g b, or nx ny nz if they are unit vectors; 7 in files that begin with the number of
///         points (PTS): x y z intensity r g b; 9: x y z r g b nx ny nz; others are refused. Colours are 0..1 if none
///         is above 1, else 0..255, or 0..65535 if any is above 255 and the columns have names.
/// Names of properties, fields and columns may be in upper or lower case. A byte-order mark before a text or a header
/// is skipped. Unsupported formats of Gaussians and clouds are refused with an error that names them
/// (refuse_foreign_format). Points that are not finite, or 1e15 m and more from the origin, are left out with one
/// warning. Normals are scaled to unit length; one that is zero or not finite is passed on as zero. Determining the
/// range of colours may take a second pass over the file. Throws InputError (file, place, fault): missing or unknown
/// file, a violation of the format, fewer points than the header declares, contradicting counts in one header, a colour
/// that is negative or not finite, no finite point at all. If a file has more rows than its header declares, only the
/// declared number is read (text: all rows), with one warning that gives both numbers.
void scan_cloud(const std::string& path, const CloudSink& sink);

/// The same from memory; `name` stands for the file, its extension included.
void scan_cloud_bytes(const std::string& name, const std::string& bytes, const CloudSink& sink);

}  // namespace odosplat
