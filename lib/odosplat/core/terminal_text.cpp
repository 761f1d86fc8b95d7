// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/terminal_text.hpp"

#include <sys/ioctl.h>

#include <cstddef>
#include <cstdint>

namespace odosplat {
namespace {

/// The UTF-8 character at the start of a text; size 0: the text does not start with a valid one.
struct Character {
  std::size_t size = 0;
  std::uint32_t code = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  std::uint32_t code = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[size] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {size, code};
}

bool between(std::uint32_t code, std::uint32_t first, std::uint32_t last) { return code >= first && code <= last; }

bool commands_terminal(std::uint32_t code) {
  return code < 0x20 || between(code, 0x7F, 0x9F) || between(code, 0x200E, 0x200F) || between(code, 0x2028, 0x202E) ||
         between(code, 0x2066, 0x2069);
}

void append_escaped(std::string& out, std::string_view bytes) {
  constexpr char digits[] = "0123456789abcdef";
  for (const char c : bytes) {
    const auto value = static_cast<unsigned char>(c);
    out += "\\x";
    out += digits[value >> 4U];
    out += digits[value & 0xFU];
  }
}

std::string printable(std::string_view text, bool keep_lines) {
  std::string out;
  out.reserve(text.size());
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::string_view bytes = text.substr(0, c.size > 0 ? c.size : 1);
    const bool layout = keep_lines && (c.code == '\n' || c.code == '\t') && c.size > 0;
    if (c.size == 0 || (commands_terminal(c.code) && !layout)) {
      append_escaped(out, bytes);
    } else {
      out += bytes;
    }
    text.remove_prefix(bytes.size());
  }
  return out;
}

constexpr std::string_view left_out = "...";
constexpr std::size_t longest_quote = 100;  // [bytes]
// [bytes] Long enough for a path of the maximum length (4096), not for two.
constexpr std::size_t line_start = 6000;
constexpr std::size_t line_end = 2000;

/// Shortens quoted parts: messages quote text from files, which can be arbitrarily long.
std::string with_short_quotes(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const std::size_t open = text.find_first_of("\"`");
    const std::size_t close = open == std::string_view::npos ? open : text.find(text[open], open + 1);
    if (close == std::string_view::npos) break;
    out += text.substr(0, open + 1);
    const std::string_view quoted = text.substr(open + 1, close - open - 1);
    if (quoted.size() > longest_quote) {
      out += cut_to_bytes(quoted, longest_quote - left_out.size());
      out += left_out;
    } else {
      out += quoted;
    }
    out += text[close];
    text.remove_prefix(close + 1);
  }
  out += text;
  return out;
}

std::string without_middle(const std::string& text) {
  if (text.size() <= line_start + line_end) return text;
  std::size_t end = text.size() - line_end;
  while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
  return std::string(cut_to_bytes(text, line_start)).append(left_out).append(text, end, std::string::npos);
}

int columns_of(std::uint32_t code) {
  const bool combining = between(code, 0x300, 0x36F) || between(code, 0x200B, 0x200D) ||
                         between(code, 0x20D0, 0x20FF) || between(code, 0xFE00, 0xFE0F) ||
                         between(code, 0xFE20, 0xFE2F);
  if (combining) return 0;
  const bool wide = between(code, 0x1100, 0x115F) || between(code, 0x2E80, 0xA4CF) || between(code, 0xAC00, 0xD7A3) ||
                    between(code, 0xF900, 0xFAFF) || between(code, 0xFE30, 0xFE6F) || between(code, 0xFF00, 0xFF60) ||
                    between(code, 0xFFE0, 0xFFE6) || between(code, 0x1F300, 0x1FAFF) || between(code, 0x20000, 0x3FFFD);
  return wide ? 2 : 1;
}

/// Number of bytes of the longest start of the text that takes at most so many columns.
std::size_t bytes_within(std::string_view text, int columns) {
  std::size_t bytes = 0;
  while (bytes < text.size()) {
    const Character c = first_character(text.substr(bytes));
    columns -= c.size > 0 ? columns_of(c.code) : 1;
    if (columns < 0) break;
    bytes += c.size > 0 ? c.size : 1;
  }
  return bytes;
}

}  // namespace

std::string printable_line(std::string_view text) {
  const std::string brief = without_middle(with_short_quotes(text));
  return escaped_line(brief);
}
std::string printable_text(std::string_view text) { return printable(text, true); }
std::string escaped_line(std::string_view text) { return printable(text, false); }

std::string_view cut_to_bytes(std::string_view text, std::size_t bytes) {
  if (text.size() <= bytes) return text;
  while (bytes > 0 && (static_cast<unsigned char>(text[bytes]) & 0xC0U) == 0x80U) --bytes;
  return text.substr(0, bytes);
}

int text_columns(std::string_view text) {
  int columns = 0;
  while (!text.empty()) {
    const Character c = first_character(text);
    columns += c.size > 0 ? columns_of(c.code) : 1;
    text.remove_prefix(c.size > 0 ? c.size : 1);
  }
  return columns;
}

std::string cut_to_columns(std::string_view text, int columns) {
  if (columns <= 0) return "";
  const std::size_t whole = bytes_within(text, columns);
  if (whole == text.size()) return std::string(text);
  return std::string(text.substr(0, bytes_within(text, columns - 1))) + "\u2026";
}

int terminal_columns(int file) {
  winsize size{};
  return ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

}  // namespace odosplat
