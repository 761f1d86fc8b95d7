// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace odosplat {

/// Throws InputError for files in formats that are not read as clouds, naming the format and how to convert it: those of
/// maps (SPZ, SOG, KSPLAT, glTF), E57, and gzip, ZIP or zstd archives. A format is recognised by the file's first bytes
/// (16 are enough) or by its extension. Returns for all other files.
void refuse_foreign_format(const std::string& name, std::string_view first_bytes);

/// The same for a PLY whose vertices are packed into integers (SuperSplat's packed PLY), recognised by its
/// properties.
void refuse_packed_ply(const std::string& name, const std::vector<std::string>& properties);

}  // namespace odosplat
