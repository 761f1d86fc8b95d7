// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/entries.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  odosplat::fuzz::pcd({reinterpret_cast<const char*>(data), size});
  return 0;
}
