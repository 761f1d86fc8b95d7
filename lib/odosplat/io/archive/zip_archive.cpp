// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/archive/zip_archive.hpp"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/io/archive/compression.hpp"
#include "odosplat/io/little_endian.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

// Sizes of the fixed parts [bytes] and the marks at which they begin.
constexpr std::size_t end_size = 22;
constexpr std::size_t entry_size = 46;
constexpr std::size_t local_size = 30;
constexpr std::string_view end_mark("PK\x05\x06", 4);
constexpr std::string_view entry_mark("PK\x01\x02", 4);
constexpr std::string_view local_mark("PK\x03\x04", 4);
constexpr std::size_t longest_comment = 65535;
constexpr std::uint16_t stored_method = 0;
constexpr std::uint16_t deflate_method = 8;

std::uint16_t u16(const std::string& bytes, std::size_t at) { return load_little<std::uint16_t>(&bytes[at]); }
std::uint32_t u32(const std::string& bytes, std::size_t at) { return load_little<std::uint32_t>(&bytes[at]); }

/// Position of the end record: the last mark whose comment ends with the file.
std::size_t find_end(const std::string& file, const std::string& bytes) {
  if (bytes.size() >= end_size) {
    const std::size_t last = bytes.size() - end_size;
    const std::size_t first = last - std::min(last, longest_comment);
    for (std::size_t at = last + 1; at-- > first;) {
      const bool is_mark = std::string_view(bytes).substr(at).starts_with(end_mark);
      if (is_mark && at + end_size + u16(bytes, at + 20) == bytes.size()) return at;
    }
  }
  throw InputError(file, "is no complete ZIP archive: its directory is missing (cut off?)");
}

}  // namespace

ZipArchive::ZipArchive(std::string file, const std::string& bytes) : file_(std::move(file)), bytes_(&bytes) {
  const std::size_t end = find_end(file_, bytes);
  const std::size_t count = u16(bytes, end + 10);
  std::size_t at = u32(bytes, end + 16);
  if (count == 0xFFFF || at == 0xFFFFFFFF) throw InputError(file_, "is a ZIP64 archive, which is not read");
  for (std::size_t i = 0; i < count; ++i) {
    if (at > end || end - at < entry_size || !std::string_view(bytes).substr(at).starts_with(entry_mark)) {
      throw InputError(file_, "is damaged: the directory of the ZIP archive is broken");
    }
    const std::size_t name_size = u16(bytes, at + 28);
    const std::size_t size = entry_size + name_size + u16(bytes, at + 30) + u16(bytes, at + 32);
    if (end - at < size) throw InputError(file_, "is damaged: the directory of the ZIP archive is cut off");
    const std::string name = bytes.substr(at + entry_size, name_size);
    if ((u16(bytes, at + 8) & 1U) != 0) throw InputError(file_, quoted_word(name), "is encrypted");
    const Member member{u16(bytes, at + 10), u32(bytes, at + 16), u32(bytes, at + 20), u32(bytes, at + 24),
                        u32(bytes, at + 42)};
    if (!members_.emplace(name, member).second) throw InputError(file_, quoted_word(name), "comes twice");
    at += size;
  }
}

std::string ZipArchive::read(const std::string& name, std::uint64_t max_bytes) const {
  const std::string place = quoted_word(name);
  const auto found = members_.find(name);
  if (found == members_.end()) throw InputError(file_, place, "is missing in the archive");
  const Member& member = found->second;
  const std::string& bytes = *bytes_;
  if (member.size > max_bytes) {
    throw InputError(file_, place,
                     "has " + std::to_string(member.size) + " bytes, over the limit of " + std::to_string(max_bytes));
  }
  const std::size_t header = member.position;
  if (bytes.size() < local_size || header > bytes.size() - local_size ||
      !std::string_view(bytes).substr(header).starts_with(local_mark)) {
    throw InputError(file_, place, "is damaged: it is not where the directory says");
  }
  const std::size_t begin = header + local_size + u16(bytes, header + 26) + u16(bytes, header + 28);
  if (begin > bytes.size() || bytes.size() - begin < member.stored) throw InputError(file_, place, "is cut off");
  const std::string_view data = std::string_view(bytes).substr(begin, member.stored);
  std::string content;
  if (member.method == stored_method) {
    if (member.stored != member.size) throw InputError(file_, place, "is damaged: its two sizes differ");
    content = std::string(data);
  } else if (member.method == deflate_method) {
    content = inflated(file_, place, data, member.size);
  } else {
    throw InputError(file_, place, "is compressed by method " + std::to_string(member.method) + ", which is not read");
  }
  if (crc32_of(content) != member.crc) throw InputError(file_, place, "is damaged: its checksum is wrong");
  return content;
}

}  // namespace odosplat
