// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/text/file_names.hpp"

#include <algorithm>
#include <filesystem>

namespace odosplat {

std::string join(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

std::string listed_file(const std::string& folder, const std::string& written) {
  std::string file = join(folder, written);
  if (written.find('\\') == std::string::npos || file_exists(file)) return file;
  std::string turned = written;
  std::replace(turned.begin(), turned.end(), '\\', '/');
  const std::string other = join(folder, turned);
  return file_exists(other) ? other : file;
}

bool file_exists(const std::string& path) {
  std::error_code error;
  return std::filesystem::is_regular_file(path, error);
}

std::string extension_of(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

bool is_image_name(const std::string& name) {
  const std::string extension = extension_of(name);
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

}  // namespace odosplat
