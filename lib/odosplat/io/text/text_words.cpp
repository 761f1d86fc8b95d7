// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/text/text_words.hpp"

#include <charconv>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

}  // namespace

std::string_view without_byte_order_mark(const std::string& name, std::string_view text) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw InputError(name, "is a text in UTF-16; save it as UTF-8");
  }
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

bool same_word(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::string_view trimmed(std::string_view text) {
  const std::size_t start = text.find_first_not_of(blanks);
  if (start == std::string_view::npos) return {};
  return text.substr(start, text.find_last_not_of(blanks) - start + 1);
}

std::string_view take_word(std::string_view& rest) {
  rest = trimmed(rest);
  const std::string_view word = rest.substr(0, std::min(rest.find_first_of(blanks), rest.size()));
  rest = trimmed(rest.substr(word.size()));
  return word;
}

std::string_view take_line(std::string_view& rest) {
  const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size()));
  rest.remove_prefix(std::min(line.size() + 1, rest.size()));
  return line;
}

std::string quoted_word(std::string_view word) {
  std::string shown(word.substr(0, 24));
  for (char& c : shown) c = is_control(c) ? '?' : c;
  return "`" + shown + "`";
}

bool has_control_characters(std::string_view name) { return std::any_of(name.begin(), name.end(), is_control); }

void fail_line(const std::string& name, std::size_t line, const std::string& fault) {
  throw InputError(name, "line " + std::to_string(line), fault);
}

double word_number(const std::string& name, std::size_t line, std::string_view word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    fail_line(name, line, quoted_word(word) + " is not a number");
  }
  return value;
}

}  // namespace odosplat
