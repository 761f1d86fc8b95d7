// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "odosplat/core/formatted.hpp"

namespace odosplat {

/// 64-bit FNV-1a hash (Fowler, Noll, Vo) of all bytes added. It detects different or damaged data; it gives no
/// protection against deliberate forgery.
class Checksum {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) {
      value_ ^= static_cast<unsigned char>(c);
      value_ *= 1099511628211ULL;
    }
  }
  void add(const void* data, std::size_t size) { add({static_cast<const char*>(data), size}); }
  std::uint64_t value() const { return value_; }
  /// 16 hexadecimal digits.
  std::string text() const { return formatted("%016llx", static_cast<unsigned long long>(value_)); }

 private:
  std::uint64_t value_ = 14695981039346656037ULL;
};

}  // namespace odosplat
