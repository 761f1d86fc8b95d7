// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cmath>

namespace odosplat {

/// What the patterns are computed of.

/// Share s of the colour b, the rest of a.
inline Eigen::Vector3f mix(const Eigen::Vector3f& a, const Eigen::Vector3f& b, float s) {
  return (1.0F - s) * a + s * b;
}

inline float fraction(float x) { return x - std::floor(x); }

}  // namespace odosplat
