// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace odosplat {

/// A ZIP archive in memory, read by its central directory (PKWARE APPNOTE 6.3): members that are stored or compressed
/// by DEFLATE. InputError(file, fault) or (file, member, fault): no ZIP archive or cut off, ZIP64, encrypted, another
/// compression, two members of one name, damaged (size or CRC-32).
class ZipArchive {
 public:
  /// `bytes` must outlive this; `file` stands for the file in errors. Nothing is decompressed.
  ZipArchive(std::string file, const std::string& bytes);

  bool has(const std::string& member) const { return members_.count(member) > 0; }
  /// The content of a member, of max_bytes at most.
  std::string read(const std::string& member, std::uint64_t max_bytes) const;

 private:
  struct Member {
    std::uint16_t method = 0;
    std::uint32_t crc = 0;
    std::uint32_t stored = 0;    // size in the archive [bytes]
    std::uint32_t size = 0;      // size of the content [bytes]
    std::uint32_t position = 0;  // of the member's local header
  };

  std::string file_;
  const std::string* bytes_;
  std::map<std::string, Member> members_;
};

}  // namespace odosplat
