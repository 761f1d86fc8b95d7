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

/// Lines of a text, numbered from 1, without line ends (LF or CR LF); a UTF-8 byte-order mark at the start is skipped.
/// Throws InputError for a line of more than 64 KiB, since such a file is not text, and for UTF-16.
class LineReader {
 public:
  LineReader(std::string name, std::istream& in);
  /// Returns false at the end.
  bool next(std::string& line);
  std::size_t number() const { return number_; }
  /// Throws InputError(name, "line N", fault) for the line read last.
  [[noreturn]] void fail(const std::string& fault) const;

 private:
  std::string name_;
  std::istream* in_;
  std::size_t number_ = 0;
};

/// Words of a line. For separator ' ' words are separated by any number of blanks and tabs; any other separator
/// separates by itself, blanks around the words are removed, and one separator at the line's end is ignored.
void split_words(std::string_view line, char separator, std::vector<std::string_view>& words);

/// A number in any usual notation: decimal, with exponent, with a leading +, nan, inf. nullopt if the word is not a
/// number or the number is out of range.
std::optional<double> number_of(std::string_view word);

/// A word for error messages: at most 24 characters.
std::string shown(std::string_view word);

}  // namespace odosplat
