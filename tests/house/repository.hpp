// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "tests/locations.hpp"

/// Access to the source tree for tests of its rules.
namespace odosplat::test::house {

namespace fs = std::filesystem;

inline const fs::path root = source_dir();

inline std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// File of a quoted include, relative to lib or to the repository; empty: not found.
inline fs::path file_of(const std::string& include) {
  for (const fs::path& base : {root / "lib", root}) {
    if (fs::is_regular_file(base / include)) return base / include;
  }
  return {};
}

}  // namespace odosplat::test::house
