// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace odosplat {

/// Makes text from files, names and other programs safe to show on a terminal. Valid UTF-8 is kept. What a terminal
/// could interpret as a command is written as escaped bytes ("\x1b"): control characters (C0, DEL, C1), characters that
/// change the writing direction or break lines (U+200E, U+200F, U+2028 to U+202E, U+2066 to U+2069), and bytes that are
/// not UTF-8. Everything that odosplat writes to standard output and standard error goes through one of these two
/// functions.
/// printable_line is for errors and other single lines: line ends and tabs are escaped too; quoted text ("..." or
/// `...`) is cut to 100 bytes; of a line longer than 8000 bytes the middle is replaced by "...".
std::string printable_line(std::string_view text);
std::string printable_text(std::string_view text);  // '\n' and '\t' stay

/// The same as printable_line, of any length.
std::string escaped_line(std::string_view text);

/// The start of a text, at most so many bytes, cut at a character boundary.
std::string_view cut_to_bytes(std::string_view text, std::size_t bytes);

/// Columns that printable UTF-8 takes on a terminal: two for wide (East Asian) characters, none for combining marks.
int text_columns(std::string_view text);

/// The start of printable UTF-8 that takes at most so many columns; it ends in an ellipsis if something was cut off.
std::string cut_to_columns(std::string_view text, int columns);

/// Columns of the terminal behind a file descriptor; 80 if it is not a terminal or reports no size.
int terminal_columns(int file);

}  // namespace odosplat
