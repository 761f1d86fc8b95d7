// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <string_view>

namespace odosplat {

/// Text of files, names and other programs as it may be shown on a terminal. UTF-8 stays as it is. What a terminal
/// could obey is written as its bytes, "\x1b": control characters (C0, DEL, C1), those that turn the direction of
/// writing or break lines (U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069), and bytes that are no UTF-8. Everything
/// that odosplat writes to standard output and standard error goes through one of these two.
/// printable_line is for errors and other single lines: line ends and tabs are escaped too; what stands in quotes
/// ("..." or `...`) is cut behind 100 bytes, and the middle of a line of more than 8000 is left out, "..." in its
/// place.
std::string printable_line(std::string_view text);
std::string printable_text(std::string_view text);  // '\n' and '\t' stay

/// Columns that printable UTF-8 takes: two for wide (East Asian) characters, none for combining marks.
int text_columns(std::string_view text);

/// The start of printable UTF-8 that takes at most so many columns; its last is an ellipsis if something was cut off.
std::string cut_to_columns(std::string_view text, int columns);

/// Columns of the terminal behind a file descriptor; 80 where it is none or does not say.
int terminal_columns(int file);

}  // namespace odosplat
