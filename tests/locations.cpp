// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/locations.hpp"

namespace odosplat::test {

std::string source_dir() { return ODOSPLAT_SOURCE_DIR; }
std::string shared_data() { return ODOSPLAT_SOURCE_DIR "/../shared/data"; }
std::string program() { return ODOSPLAT_PROGRAM_DIR "/odosplat"; }
std::string example() { return ODOSPLAT_PROGRAM_DIR "/odosplat_example"; }

}  // namespace odosplat::test
