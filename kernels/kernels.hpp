// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string_view>

namespace odosplat::kernels {

/// Text of one file of this folder, as it was when the library was built ("composite.cl", "constants.h").
/// Throws std::logic_error for a name that is not there: the names are written in our own code, never by a user.
std::string_view source(std::string_view name);

}  // namespace odosplat::kernels
