// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <functional>
#include <string>

#include "odosplat/core/cloud_batch.hpp"

namespace odosplat {

/// Takes a batch; may throw, which ends the scan.
using CloudSink = std::function<void(const CloudBatch&)>;

/// Reads a point cloud of any size, handing it on in batches of at most 65536 points in the order of the file; no more
/// than a few batches are held in memory. A batch has colours and normals if the file has.
///
/// The format is told by the first bytes (PLY, PCD, LAS), else by the extension (.ply .pcd .las .xyz .csv .txt .asc
/// .pts):
///   PLY   ascii and binary of both byte orders; element `vertex`, x y z of any scalar type; optional red green blue
///         (diffuse_red .., r g b): 0..255; if any is above 255 and the type is wider than a byte, 0..65535; floats
///         0..1 if none is above 1; optional nx ny nz; other properties, lists and elements are read past.
///   PCD   ascii, binary, binary_compressed; x y z of any SIZE and TYPE; optional rgb or rgba packed into 4 bytes, or r
///         g b as in PLY; optional normal_x normal_y normal_z (nx ny nz); other fields and COUNTs are read past, and
///         so is VIEWPOINT.
///   LAS   1.0 to 1.4, point formats 0 to 10, uncompressed: scale and offset applied; colours where the format has
///         them: over 65535, or over 255 if none is above; all black = none. Points marked as withheld are left out.
///         LAZ is refused.
///   text  a point a line, separated by blanks, commas or semicolons (the first point's line tells); # and // start
///         comments; a first line may name the columns (x y z, r g b or red green blue, nx ny nz or normal_x ..;
///         others, such as intensity, are ignored). Without names: 3 columns are x y z; 4: and something ignored; 6: x
///         y z and r g b, or nx ny nz if they are unit vectors; 7 in files that begin with the number of points (PTS):
///         x y z intensity r g b; 9: x y z r g b nx ny nz; others are refused. Colours are 0..1 if none is above 1,
///         else 0..255, or 0..65535 if any is above 255 and the columns have names.
/// Names of properties, fields and columns may be in letters of either size. A byte-order mark before a text or a
/// header is passed over. Formats of Gaussians and of other clouds that are not read are refused by their names. Points
/// that are not finite, or 1e15 m and more from the origin, are left out with one warning. Normals are scaled to unit
/// length; one that is zero or not finite is handed on as zero. Telling the range of colours may take a second pass
/// over the file. Throws InputError (file, place, fault): missing or unknown file, what the format forbids, more points
/// promised than there are, counts of one header that contradict each other, a colour that is negative or not finite,
/// no finite point at all. A file that holds more rows than its header promises is read as far as that (text: to its
/// end), with one warning of both numbers.
void scan_cloud(const std::string& path, const CloudSink& sink);

/// The same from memory; `name` stands for the file, its extension included.
void scan_cloud_bytes(const std::string& name, const std::string& bytes, const CloudSink& sink);

}  // namespace odosplat
