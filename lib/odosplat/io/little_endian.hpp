// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>

namespace odosplat {

/// The value whose bytes, least significant first, start at `bytes`; no alignment needed.
template <typename T>
T load_little(const char* bytes) {
  std::array<char, sizeof(T)> ordered;
  std::memcpy(ordered.data(), bytes, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(ordered.begin(), ordered.end());
  T value;
  std::memcpy(&value, ordered.data(), sizeof(T));
  return value;
}

/// Appends the bytes of a value, least significant first.
template <typename T>
void append_little(std::string& bytes, T value) {
  std::array<char, sizeof(T)> ordered;
  std::memcpy(ordered.data(), &value, sizeof(T));
  if constexpr (std::endian::native == std::endian::big) std::reverse(ordered.begin(), ordered.end());
  bytes.append(ordered.data(), ordered.size());
}

}  // namespace odosplat
