// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace odosplat {

/// Refuses files of maps and clouds in formats that are not read, naming the format and a way to convert it, where
/// their first bytes (16 are enough) or else their extension tell: SPZ, SOG, KSPLAT, glTF, E57, ZIP and gzip archives.
/// InputError if so; returns otherwise.
void refuse_foreign_format(const std::string& name, std::string_view first_bytes);

/// The same for a PLY whose vertices are packed into integers (SuperSplat's compressed PLY), told by its properties.
void refuse_packed_ply(const std::string& name, const std::vector<std::string>& properties);

}  // namespace odosplat
