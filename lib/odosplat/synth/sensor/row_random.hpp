// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

#include "odosplat/core/random.hpp"

namespace odosplat {

/// A separate random stream for every row of every frame, so that noise does not depend on which thread computes which
/// row.
inline Random row_random(std::uint64_t seed, int frame, int row) {
  return Random(seed * 0x9E3779B97F4A7C15ULL + (static_cast<std::uint64_t>(static_cast<std::uint32_t>(frame)) << 16) +
                static_cast<std::uint64_t>(row));
}

}  // namespace odosplat
