// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/text/json_text.hpp"

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

using Json = nlohmann::json;

constexpr std::string_view null_word = "null";

struct Plain {
  std::string text;                 // valid JSON in place of Python's numbers
  std::vector<std::size_t> longer;  // positions of characters in it that the file does not have
};

bool is_word_character(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// Replaces numbers that JSON does not allow by null, padded with blanks to their length where that is longer.
Plain without_infinities(std::string_view text) {
  Plain plain;
  plain.text.reserve(text.size());
  bool in_string = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (in_string) {
      const bool is_escape = text[i] == '\\' && i + 1 < text.size();
      in_string = text[i] != '"';
      plain.text.push_back(text[i]);
      if (is_escape) plain.text.push_back(text[++i]);
      continue;
    }
    in_string = text[i] == '"';
    const bool begins_word = i == 0 || !is_word_character(text[i - 1]);
    std::size_t length = 0;
    for (const std::string_view word : {"NaN", "-NaN", "Infinity", "-Infinity"}) {
      const std::size_t end = i + word.size();
      if (begins_word && text.substr(i).starts_with(word) && (end >= text.size() || !is_word_character(text[end]))) {
        length = word.size();
      }
    }
    if (length == 0) {
      plain.text.push_back(text[i]);
      continue;
    }
    plain.text += null_word;
    if (length < null_word.size()) plain.longer.push_back(plain.text.size() - 1);
    if (length > null_word.size()) plain.text.append(length - null_word.size(), ' ');
    i += length - 1;
  }
  return plain;
}

// The last part of "[json.exception...] parse error at line 1, column 2: syntax error while parsing value -
// unexpected ...".
std::string reason_of(const std::string& message) {
  const std::size_t dash = message.find(" - ");
  const std::size_t colon = message.find(": ");
  std::string reason = dash != std::string::npos    ? message.substr(dash + 3)
                       : colon != std::string::npos ? message.substr(colon + 2)
                                                    : message;
  reason.resize(std::min<std::size_t>(reason.size(), 100));
  // Non-ASCII characters are replaced, because the cut may have split one.
  for (char& c : reason) c = static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) >= 0x7f ? '?' : c;
  return reason;
}

// Throws the error of a parser that stopped after byte `at` (from 1) of the plain text.
[[noreturn]] void fail_at(const std::string& name, const Plain& plain, std::size_t at, const std::string& message) {
  const std::size_t end = std::min(at > 0 ? at - 1 : 0, plain.text.size());
  const std::string_view before(plain.text.data(), end);
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const auto added = std::count_if(plain.longer.begin(), plain.longer.end(),
                                   [&](std::size_t place) { return place >= line_start && place < end; });
  const std::size_t line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t column = 1 + end - line_start - static_cast<std::size_t>(added);
  const std::string place = "line " + std::to_string(line) + ", column " + std::to_string(column);
  const std::size_t last = before.find_last_not_of(" \t\r\n");
  const char next = end < plain.text.size() ? plain.text[end] : '\0';
  if (last != std::string_view::npos && before[last] == ',' && (next == ']' || next == '}')) {
    throw InputError(name, place, std::string("is not JSON: there is a comma before `") + next + "`");
  }
  throw InputError(name, place, "is not JSON: " + reason_of(message));
}

}  // namespace

Json parse_json_object(const std::string& name, const std::string& text) {
  const Plain plain = without_infinities(without_byte_order_mark(name, text));
  Json json;
  try {
    json = Json::parse(plain.text);
  } catch (const Json::parse_error& e) {
    fail_at(name, plain, e.byte, e.what());
  } catch (const Json::exception& e) {
    throw InputError(name, "is not JSON: " + reason_of(e.what()));
  }
  if (!json.is_object()) throw InputError(name, "is not a JSON object");
  return json;
}

}  // namespace odosplat
