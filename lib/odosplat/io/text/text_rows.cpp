// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/text/text_rows.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

constexpr std::size_t max_line = std::size_t{1} << 16;

}  // namespace

LineReader::LineReader(std::string name, std::istream& in) : name_(std::move(name)), in_(&in) {}

bool LineReader::next(std::string& line) {
  line.clear();
  ++number_;
  std::streambuf& buffer = *in_->rdbuf();
  constexpr int end = std::char_traits<char>::eof();
  int c = buffer.sbumpc();
  if (c == end) return false;
  for (; c != end && c != '\n'; c = buffer.sbumpc()) {
    line.push_back(static_cast<char>(c));
    if (line.size() > max_line) fail("is longer than a line of text can be");
  }
  if (!line.empty() && line.back() == '\r') line.pop_back();
  if (number_ == 1) line.erase(0, line.size() - without_byte_order_mark(name_, line).size());
  return true;
}

void LineReader::fail(const std::string& fault) const {
  throw InputError(name_, "line " + std::to_string(number_), fault);
}

void split_words(std::string_view line, char separator, std::vector<std::string_view>& words) {
  words.clear();
  if (separator != ' ') {
    for (line = trimmed(line); !line.empty();) {
      const std::size_t end = std::min(line.find(separator), line.size());
      words.push_back(trimmed(line.substr(0, end)));
      line.remove_prefix(std::min(end + 1, line.size()));
    }
    return;
  }
  while (true) {
    const std::size_t start = line.find_first_not_of(blanks);
    if (start == std::string_view::npos) return;
    line.remove_prefix(start);
    const std::size_t end = std::min(line.find_first_of(blanks), line.size());
    words.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::optional<double> number_of(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (word.empty() || error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

std::string shown(std::string_view word) {
  std::string text(word.substr(0, 24));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; }, '?');
  return text;
}

}  // namespace odosplat
