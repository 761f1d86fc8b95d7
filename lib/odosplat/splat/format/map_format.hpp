// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace odosplat {

/// File formats of maps of Gaussians. A packed PLY (packed_ply.hpp) is a PLY.
enum class MapFormat { ply, splat, spz, gltf, sog };

/// "PLY", ".splat", "SPZ", "glTF", "SOG".
const char* format_name(MapFormat format);

/// The format that a name's extension stands for, in letters of either size: .ply, .splat, .spz, .glb and .gltf, .sog,
/// and the name meta.json (SOG). None: another extension.
std::optional<MapFormat> format_of_name(const std::string& path);

/// The format of a file by its first bytes, 4096 or all of them. Only .splat has no mark of its own: it is recognised by
/// its name, unless the content has a mark of four bytes of another format. None: no format of maps.
std::optional<MapFormat> format_of_content(const std::string& path, std::string_view first_bytes);

/// InputError if the name stands for a format (but PLY, whose reader says what is wrong) and the content is of none.
void require_format_of_name(const std::string& path, const std::optional<MapFormat>& found);
/// One warning that names both formats if the name stands for another one than was found.
void warn_of_other_format(const std::string& path, MapFormat found);

}  // namespace odosplat
