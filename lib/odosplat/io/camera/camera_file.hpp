// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

#include "odosplat/io/camera/camera_entries.hpp"

namespace odosplat {

/// Throws InputError(file, key, fault): a key missing, unknown or given twice, not a number, not finite, several
/// YAML documents, another number of distortion coefficients than 4 or 5, and what check_camera refuses; reading from a
/// path: a vignette that is not there.
CameraFile read_camera_file(const std::string& path);
/// The same from text; `name` stands for the file in errors.
CameraFile parse_camera_file(const std::string& name, const std::string& text);

/// Writes width .. cy, depth_scale and what else is set; numbers so that reading gives the same bits.
/// InputError if the path cannot be written.
void write_camera_file(const std::string& path, const CameraFile& file);

}  // namespace odosplat
