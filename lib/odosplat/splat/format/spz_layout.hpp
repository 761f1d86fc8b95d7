// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace odosplat::spz {

inline constexpr std::string_view magic = "NGSP";
inline constexpr std::uint32_t latest_version = 4;
inline constexpr std::size_t gzip_header = 16;  // of versions 1 to 3 [bytes]
inline constexpr std::size_t zstd_header = 32;  // of version 4
inline constexpr std::size_t table_row = 16;    // compressed and uncompressed size of a stream
inline constexpr std::uint8_t antialiased = 1;  // flags of the header
inline constexpr std::uint8_t extended = 2;
inline constexpr int most_degree = 4;

/// Type of the extension that holds the lines of our header: vendor 0x0D05, number 1.
inline constexpr std::uint32_t lines_extension = 0x0D050001;

inline constexpr float color_scale = 0.15F;
inline constexpr float scale_steps = 16.0F;  // a unit of ln m
inline constexpr float least_log_scale = -10.0F;
inline constexpr float sh_steps = 128.0F;
inline constexpr std::uint32_t rotation_steps = 511;  // from 0 to 1/sqrt(2)

/// Bytes a Gaussian of positions, alphas, colours, scales, rotations and harmonics.
inline std::array<std::size_t, 6> widths(std::uint32_t version, int degree) {
  const auto rest = static_cast<std::size_t>((degree + 1) * (degree + 1) - 1);
  return {version == 1 ? 6U : 9U, 1, 3, 3, version >= 3 ? 4U : 3U, 3 * rest};
}

}  // namespace odosplat::spz
