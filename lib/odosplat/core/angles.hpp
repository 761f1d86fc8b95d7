// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <numbers>

namespace odosplat {

inline constexpr double degrees_per_radian = 180.0 / std::numbers::pi;
inline constexpr double radians_per_degree = std::numbers::pi / 180.0;
inline constexpr float float_pi = std::numbers::pi_v<float>;

}  // namespace odosplat
