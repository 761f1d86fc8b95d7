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

/// Decompresses LZF (Lehmann's format, as PCD files use it) piece by piece. A copy goes on from the same place, so that
/// places of one stream can be read side by side in little memory: references reach back 8192 bytes at most.
/// Format: a control byte c < 32 is followed by c + 1 literal bytes; else c >> 5 = 1..6 says that 3..8 bytes are
/// repeated, 7 that the next byte + 9 are; they start ((c & 31) << 8 | last byte) + 1 bytes back.
class LzfStream {
 public:
  /// Bytes [begin, end) of `in`, which must outlive this; `name` stands for the file in errors.
  LzfStream(std::string name, std::istream& in, std::uint64_t begin, std::uint64_t end);

  /// The next n decompressed bytes; to == nullptr: they are passed over. InputError if the stream ends before or refers
  /// to what was before its start.
  void read(char* to, std::size_t n);

 private:
  [[noreturn]] void fail() const;
  std::uint8_t byte();
  void next_run();

  static constexpr std::size_t window_size = 8192;

  std::string name_;
  std::istream* in_;
  std::uint64_t at_;  // of the first byte that is not in buffer_
  std::uint64_t end_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;  // of buffer_
  std::array<char, window_size> window_{};
  std::uint64_t made_ = 0;  // bytes decompressed
  std::size_t literal_ = 0;
  std::size_t repeat_ = 0;
  std::size_t distance_ = 0;
};

}  // namespace odosplat
