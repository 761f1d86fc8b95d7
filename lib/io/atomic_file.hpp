// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// Writes `bytes` to a file beside `path` and renames it: a reader sees the old file or the whole new one, never a
/// part. Missing parent folders are made. Throws InputError naming the path and the reason; nothing is left behind
/// then.
void write_file_atomically(const std::string& path, const std::string& bytes);

/// Makes the folder (and its parents) if need be and proves that files can be written there. InputError otherwise.
/// Programs call this before they compute anything.
void ensure_output_folder(const std::string& path);

/// The same for the folder of a file that will be written later.
void ensure_output_file(const std::string& path);

/// Whole content of a regular file. InputError if it is missing, a folder, or cannot be read.
std::string read_file(const std::string& path);

}  // namespace odosplat
