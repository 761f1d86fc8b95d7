// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace odosplat {

/// Lines of a text, numbered from 1, without their ends (LF or CR LF); a byte-order mark of UTF-8 before the first is
/// passed over. InputError for a line of more than 64 KiB (that is no text) and for UTF-16.
class LineReader {
 public:
  LineReader(std::string name, std::istream& in);
  /// false at the end.
  bool next(std::string& line);
  std::size_t number() const { return number_; }
  /// Throws InputError(name, "line N", fault) for the last line.
  [[noreturn]] void fail(const std::string& fault) const;

 private:
  std::string name_;
  std::istream* in_;
  std::size_t number_ = 0;
};

/// Words of a line. separator ' ': blanks and tabs, any number of them; another: that character alone, blanks around
/// the words are cut off, and one separator at the line's end is ignored.
void split_words(std::string_view line, char separator, std::vector<std::string_view>& words);

/// A number as printed by anyone: decimal, exponent, a leading +, nan, inf. Nothing if it is none or out of range.
std::optional<double> number_of(std::string_view word);

/// A word as an error shows it: not more than 24 characters.
std::string shown(std::string_view word);

}  // namespace odosplat
