// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace odosplat {

/// Splitting text into lines and words, for the readers of lists.

/// Space, tab and carriage return.
inline constexpr std::string_view blanks = " \t\r";

/// UTF-8 byte-order mark, with which some editors start a file.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The text without a UTF-8 byte-order mark at its start. Throws InputError if the text starts with the byte-order mark
/// of UTF-16 (either byte order) or little-endian UTF-32, which the readers cannot decode.
std::string_view without_byte_order_mark(const std::string& name, std::string_view text);

/// True if two words are equal when upper and lower case of ASCII letters are not distinguished.
bool same_word(std::string_view a, std::string_view b);

std::string_view trimmed(std::string_view text);

/// Removes the first word from `rest` and returns it; empty if there is none. Afterwards `rest` has no blanks at its
/// ends.
std::string_view take_word(std::string_view& rest);

/// Removes the first line from `rest` and returns it without its line end.
std::string_view take_line(std::string_view& rest);

/// A word for one-line error messages: at most 24 bytes in back quotes, control characters shown as ?.
std::string quoted_word(std::string_view word);

/// True if a name contains control characters, so that it cannot be shown in one line or written into a list.
bool has_control_characters(std::string_view name);

/// Throws InputError(name, "line N", fault).
[[noreturn]] void fail_line(const std::string& name, std::size_t line, const std::string& fault);

/// The word as a finite number; calls fail_line if it is not one.
double word_number(const std::string& name, std::size_t line, std::string_view word);

/// Calls visit(line number from 1, trimmed text) for every line that is neither empty nor a comment (#). A byte-order
/// mark is handled by without_byte_order_mark; `name` stands for the file in its error.
template <typename Visit>
void for_each_line(const std::string& name, std::string_view text, Visit visit) {
  text = without_byte_order_mark(name, text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (!line.empty() && line[0] != '#') visit(number, line);
  }
}

}  // namespace odosplat
