// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace odosplat {

/// Checks the comments of a map's header that training writes, one "NAME value" each. InputError(field, fault) for a
/// format that this program does not know ("odosplat map, format 2"), for a field that comes twice, and for a value
/// that is no number, not whole where it counts something, or outside the range that the field can have. Other comments
/// are ignored; settings that are never read back (rates, intervals) are checked in files of our format alone, since
/// another program's comment may begin with the same word.
void check_map_header(const std::vector<std::string>& comments);

/// Whether a comment begins with the name of a setting that is never read back: in a file of another program it may
/// mean anything.
bool names_map_setting(const std::string& comment);

/// The number of a field; none if no line names it, or its value is no number.
std::optional<double> map_header_number(const std::vector<std::string>& comments, std::string_view field);

}  // namespace odosplat
