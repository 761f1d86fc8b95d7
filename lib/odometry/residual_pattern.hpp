// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>

namespace odosplat {

/// DSO's residual pattern: offsets [px] around a point; 8 pixels, so that two SIMD registers hold them.
inline constexpr int pattern_size = 8;
inline constexpr std::array<std::array<int, 2>, pattern_size> pattern = {
    {{0, -2}, {-1, -1}, {1, -1}, {-2, 0}, {0, 0}, {2, 0}, {-1, 1}, {0, 2}}};

}  // namespace odosplat
