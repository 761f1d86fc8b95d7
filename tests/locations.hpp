// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat::test {

/// Paths that the tests need at run time. Those of the build are compiled only into locations.cpp, so that a compiler
/// cache can be shared by several checkouts.
std::string source_dir();   // the repository
std::string shared_data();  // folder of public data sets beside the repository; may be missing
std::string program();      // odosplat, of the same build
std::string example();      // apps/example, of the same build

}  // namespace odosplat::test
