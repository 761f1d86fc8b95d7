// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <initializer_list>
#include <string>

#include "odosplat/io/atomic_file.hpp"

namespace odosplat::apps {

/// ensure_output_file for an optional flag: does nothing for an empty path.
[[nodiscard]] MadeFolders ensure_output_if_given(const std::string& path);

/// InputError unless the name ends in one of the extensions (".ply", in upper or lower case), since readers tell the
/// format by the extension.
void check_extension(const std::string& path, std::initializer_list<const char*> extensions);

/// printf to standard output, for all results. Control characters in the text are escaped (printable_text); line ends
/// are kept. InputError if it cannot be written.
[[gnu::format(printf, 1, 2)]] void print(const char* format, ...);

/// Flushes standard output. InputError if not all of it could be written (a full disk).
void finish_output();

}  // namespace odosplat::apps
