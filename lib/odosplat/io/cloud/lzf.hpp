// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace odosplat {

/// Decompresses LZF (Lehmann's format, used in PCD files) piece by piece. A copy of the object continues from the same
/// position independently, so that several positions of one stream can be read in parallel; this takes little memory,
/// because references reach back 8192 bytes at most.
/// Format, for a control byte c:
///   c < 32           c + 1 literal bytes follow
///   c >> 5 = 1..6    (c >> 5) + 2 bytes are repeated (3..8)
///   c >> 5 = 7       the next byte + 9 bytes are repeated
/// Repeated bytes start ((c & 31) << 8 | d) + 1 bytes back, where d is the byte after c (and after the length byte).
class LzfStream {
 public:
  /// Bytes [begin, end) of `in`, which must outlive this; `name` stands for the file in errors.
  LzfStream(std::string name, std::istream& in, std::uint64_t begin, std::uint64_t end);

  /// Reads the next n decompressed bytes; to == nullptr: skips them. Throws InputError if the stream ends earlier or
  /// refers to bytes before its start.
  void read(char* to, std::size_t n);

 private:
  [[noreturn]] void fail() const;
  std::uint8_t byte();
  void next_run();

  static constexpr std::size_t window_size = 8192;

  std::string name_;
  std::istream* in_;
  std::uint64_t at_;  // position of the first byte after those in buffer_
  std::uint64_t end_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;  // bytes of buffer_ already consumed
  std::array<char, window_size> window_{};
  std::uint64_t made_ = 0;  // bytes decompressed
  std::size_t literal_ = 0;
  std::size_t repeat_ = 0;
  std::size_t distance_ = 0;
};

}  // namespace odosplat
