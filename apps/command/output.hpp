// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <initializer_list>
#include <string>

#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {

/// ensure_output_file for a flag that may be left out: nothing for an empty path.
[[nodiscard]] MadeFolders ensure_output_if_given(const std::string& path);

/// InputError unless the name ends in one of the extensions (".ply"), in letters of either size: whoever
/// reads it tells the format by that.
void check_extension(const std::string& path, std::initializer_list<const char*> extensions);

/// printf to standard output for results: the one way there. Text of files and names among the arguments is shown
/// without control characters (core/terminal_text.hpp); line ends stay. InputError where it cannot be written.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);

/// Writes out what waits in buffers; InputError where standard output did not take all of it (a full disk).
void finish_output();

}  // namespace odosplat::apps
