// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/foreign_text.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>

namespace odosplat::apps {
namespace {

/// Length in bytes of the UTF-8 character at the start. 0 if it is invalid: a wrong or missing byte, an overlong
/// encoding, a surrogate, or a code point beyond U+10FFFF.
std::size_t character_size(std::string_view bytes) {
  const auto at = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
  const unsigned char first = at(0);
  if (first < 0x80) return 1;
  const std::size_t size = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (size == 0 || bytes.size() < size) return 0;
  for (std::size_t i = 1; i < size; ++i) {
    if ((at(i) & 0xc0U) != 0x80) return 0;
  }
  const unsigned char second = at(1);
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f)) return 0;
  if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f)) return 0;
  return size;
}

/// Whether a character is a control character: of ASCII, or U+0080 to U+009F, which terminals interpret as well.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  if (character.size() == 1) return first < 0x20 || first == 0x7f;
  return first == 0xc2 && static_cast<unsigned char>(character[1]) < 0xa0;
}

/// The last `most` bytes of a file; empty unless it is a regular file.
std::string tail_of(const std::string& file, off_t most) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return "";
  std::string text;
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) {
    text.resize(static_cast<std::size_t>(std::min(most, status.st_size)));
    const ssize_t n = ::pread(descriptor, text.data(), text.size(), std::max<off_t>(0, status.st_size - most));
    text.resize(static_cast<std::size_t>(std::max<ssize_t>(0, n)));
  }
  ::close(descriptor);
  return text;
}

}  // namespace

std::string clean_text(std::string_view bytes, std::size_t longest) {
  std::string text;
  while (!bytes.empty()) {
    const std::size_t size = character_size(bytes);
    const std::string_view character = bytes.substr(0, std::max<std::size_t>(1, size));
    const std::string_view shown = size == 0 || is_control(character) ? "?" : character;
    if (text.size() + shown.size() > longest) return text + "...";
    text += shown;
    bytes.remove_prefix(character.size());
  }
  return text;
}

std::string last_line(const std::string& file) {
  constexpr off_t most = 1 << 16;
  std::string text = tail_of(file, most);
  while (!text.empty()) {
    const std::size_t start = text.find_last_of("\r\n");
    const std::string line = start == std::string::npos ? text : text.substr(start + 1);
    if (line.find_first_not_of(" \t") != std::string::npos) return clean_text(line);
    text.resize(start == std::string::npos ? 0 : start);
  }
  return "";
}

}  // namespace odosplat::apps
