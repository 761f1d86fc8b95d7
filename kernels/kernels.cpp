// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "kernels/kernels.hpp"

#include <map>
#include <stdexcept>
#include <string>

namespace odosplat::kernels {

/// This folder's files by name; odosplat_embed() in CMakeLists.txt writes it.
const std::map<std::string_view, std::string_view>& kernel_files();

std::string_view source(std::string_view name) {
  const auto file = kernel_files().find(name);
  if (file == kernel_files().end()) throw std::logic_error("no kernel file is called " + std::string(name));
  return file->second;
}

}  // namespace odosplat::kernels
