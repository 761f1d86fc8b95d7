// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace odosplat {

/// Data that decompress to at most this many times their own size are accepted without a further check. Larger ones are
/// made to fill the memory: DEFLATE reaches 1032, zstd more, and quantised maps stay below 50.
inline constexpr std::uint64_t most_compression = 128;

/// InputError(file, fault) if `declared` bytes are more than `stored` bytes can reasonably decompress to. To be called
/// with the sizes that a header declares, before memory for them is allocated.
void require_plausible_size(const std::string& file, std::uint64_t declared, std::uint64_t stored);

/// A gzip stream (RFC 1952) in memory that is decompressed piece by piece, so that a header at its start is checked
/// before the rest is. InputError(file, fault): no gzip, damaged, ends too early.
class GzipStream {
 public:
  /// `bytes` must outlive this; `file` stands for the file in errors.
  GzipStream(std::string file, std::string_view bytes);
  ~GzipStream();
  GzipStream(const GzipStream&) = delete;
  GzipStream& operator=(const GzipStream&) = delete;

  /// The next n decompressed bytes. Memory grows with what is decompressed, not with n.
  std::string read(std::size_t n);
  /// Skips what is left; throws unless the data are complete and have the checksum that they declare.
  void finish();

 private:
  struct State;
  std::string file_;
  std::unique_ptr<State> state_;
};

/// Raw DEFLATE data (RFC 1951) that decompress to exactly `size` bytes. InputError(file, place, fault).
std::string inflated(const std::string& file, const std::string& place, std::string_view bytes, std::size_t size);

/// zstd frames (RFC 8878) that decompress to exactly `size` bytes. InputError(file, place, fault).
std::string zstd_decompressed(const std::string& file, const std::string& place, std::string_view bytes,
                              std::size_t size);

/// One zstd frame with a checksum, the same bytes for the same input; its size is in the frame's header.
std::string zstd_compressed(std::string_view bytes);

/// CRC-32 as gzip and ZIP use it.
std::uint32_t crc32_of(std::string_view bytes);

}  // namespace odosplat
