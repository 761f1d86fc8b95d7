// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

std::string join(const std::string& folder, const std::string& name);
/// The file that a list names, relative to the list's folder. Backslashes are taken as folder separators if the file
/// exists only under that reading (lists made on Windows).
std::string listed_file(const std::string& folder, const std::string& written);
bool file_exists(const std::string& path);
/// Lower-case extension with its dot (".png").
std::string extension_of(const std::string& name);
bool is_image_name(const std::string& name);

}  // namespace odosplat
