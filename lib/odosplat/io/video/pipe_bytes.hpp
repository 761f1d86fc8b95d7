// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace odosplat {

/// Bytes of a pipe, read without being blocked for long: while there are none, `given_up` is asked every 20 ms.
class PipeBytes {
 public:
  /// source: "-" for standard input, or the path of a FIFO. Does not wait for a writer. Throws InputError naming
  /// `source` if it cannot be opened, or if standard input is a terminal.
  PipeBytes(const std::string& source, std::function<bool()> given_up);
  ~PipeBytes();
  PipeBytes(const PipeBytes&) = delete;
  PipeBytes& operator=(const PipeBytes&) = delete;

  enum class Result { bytes, end, given_up, failed };
  /// Reads 1 to `most` bytes; end: all writers have closed the pipe. count: number of bytes read, else errno.
  Result read(std::uint8_t* to, std::size_t most, int& count);

 private:
  int file_ = -1;
  std::function<bool()> given_up_;
};

}  // namespace odosplat
