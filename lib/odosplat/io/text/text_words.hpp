// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace odosplat {

/// Text of blanks, words and lines, for the readers of lists. Blanks are space, tab and carriage return.

/// The bytes with which some editors begin a text in UTF-8.
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

/// The text behind a byte-order mark of UTF-8, if it begins with one. InputError for one of UTF-16 or UTF-32: such a
/// text would be read as rubbish.
std::string_view without_byte_order_mark(const std::string& name, std::string_view text);

/// True if two words differ in the size of ASCII letters only.
bool same_word(std::string_view a, std::string_view b);

std::string_view trimmed(std::string_view text);

/// Takes the first word off `rest`; empty if there is none. What is left has no blanks at its ends.
std::string_view take_word(std::string_view& rest);

/// Takes the first line off `rest`, without its line end.
std::string_view take_line(std::string_view& rest);

/// A word for an error of one line: at most 24 bytes in back quotes, control characters as ?.
std::string quoted_word(std::string_view word);

/// True if a name could not be shown in one line or written into a list: it holds control characters.
bool has_control_characters(std::string_view name);

/// Throws InputError(name, "line N", fault).
[[noreturn]] void fail_line(const std::string& name, std::size_t line, const std::string& fault);

/// The word as a finite number, or fail_line.
double word_number(const std::string& name, std::size_t line, std::string_view word);

/// Calls visit(line number from 1, trimmed text) for every line that holds something and is no comment (#). A
/// byte-order mark is passed over as without_byte_order_mark says; `name` stands for the file in its error.
template <typename Visit>
void for_each_line(const std::string& name, std::string_view text, Visit visit) {
  text = without_byte_order_mark(name, text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (!line.empty() && line[0] != '#') visit(number, line);
  }
}

}  // namespace odosplat
