// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string_view>

namespace odosplat::kernels {

/// Text of one file of this folder ("composite.cl", "constants.h"), embedded when the library was built.
/// Throws std::logic_error for an unknown name, since names come only from this project's code, never from a user.
std::string_view source(std::string_view name);

}  // namespace odosplat::kernels
