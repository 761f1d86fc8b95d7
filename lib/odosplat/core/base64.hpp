// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>

namespace odosplat {

/// RFC 4648, with padding.
std::string base64(std::string_view bytes);

}  // namespace odosplat
