// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::test {

/// Where the tests find what is not compiled into them. Paths of the build are compiled into locations.cpp alone, so
/// that a compiler cache serves every checkout.
std::string source_dir();   // the repository
std::string shared_data();  // folder of public data sets beside the repository; may be missing
std::string program();      // odosplat, of the same build
std::string example();      // apps/example, of the same build

}  // namespace odosplat::test
