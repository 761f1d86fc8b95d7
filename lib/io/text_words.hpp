// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

namespace odosplat {

/// Text of blanks, words and lines, for the readers of lists. Blanks are space, tab and carriage return.

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

/// Calls visit(line number from 1, trimmed text) for every line that holds something and is no comment (#).
template <typename Visit>
void for_each_line(std::string_view text, Visit visit) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (!line.empty() && line[0] != '#') visit(number, line);
  }
}

}  // namespace odosplat
