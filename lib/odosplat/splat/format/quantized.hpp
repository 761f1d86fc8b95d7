// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace odosplat {

/// What the compact formats have in common: values of Gaussians in bytes.

inline constexpr float full_opacity_logit = 20.0F;  // of an opacity that equals 1 in single precision (negative: 0)
inline constexpr float zero_log_scale = -23.0F;     // 1e-10 m: stands for a size of 0
inline constexpr float sqrt_half = 0.70710678F;     // the largest second component of a unit quaternion

/// The nearest whole number in 0..255; NaN counts as 0.
inline std::uint8_t rounded_byte(float value) {
  return value > 0.0F ? static_cast<std::uint8_t>(std::lround(std::min(value, 255.0F))) : std::uint8_t{0};
}

inline float byte_value(char byte) { return static_cast<float>(static_cast<std::uint8_t>(byte)); }

inline float opacity_of_logit(float logit) { return 1.0F / (1.0F + std::exp(-logit)); }

/// The logit of an opacity in 0..1, finite for 0 and 1 too; NaN stays NaN.
inline float logit_of_opacity(float opacity) {
  const float logit = std::log(opacity / (1.0F - opacity));
  return std::isnan(logit) ? logit : std::clamp(logit, -full_opacity_logit, full_opacity_logit);
}

/// The logit of an opacity in steps of 1/255; 0 and 255 count as a quarter of a step from the end, since their logits
/// would be infinite.
inline float logit_of_opacity_byte(float byte) { return logit_of_opacity(std::clamp(byte, 0.25F, 254.75F) / 255.0F); }

/// The component of a unit quaternion that was left out, positive, from the three others; quaternion[largest] is 0.
inline void restore_largest(float* quaternion, std::size_t largest) {
  float rest = 1.0F;
  for (std::size_t a = 0; a < 4; ++a) rest -= quaternion[a] * quaternion[a];
  quaternion[largest] = std::sqrt(std::max(rest, 0.0F));
}

}  // namespace odosplat
