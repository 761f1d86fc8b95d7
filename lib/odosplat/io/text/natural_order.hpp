// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace odosplat {

/// Natural order of names: runs of digits compare as numbers of any length ("2.png" before "10.png"), everything else
/// byte by byte; names that differ only in leading zeros compare as text. A strict total order.
bool natural_less(std::string_view a, std::string_view b);

/// Names in `folder` (files and folders), in natural order. Throws InputError if it cannot be listed. Names that begin
/// with a dot are left out: macOS adds a file "._NAME" for every NAME on drives of other systems and in archives.
std::vector<std::string> list_folder(const std::string& folder);

/// The last run of digits of a file name without its extension, -1 if there is none or it has more than 15 digits:
/// "frame-000012.color.png" gives 12 for the stem "frame-000012".
long long number_in(std::string_view stem);

}  // namespace odosplat
