// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/pcd_header.hpp"

#include <charconv>
#include <optional>
#include <set>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::size_t max_stride = std::size_t{1} << 20;  // [bytes] far above the length of any real row

class PcdHeaderReader {
 public:
  PcdHeaderReader(const std::string& name, LineReader& lines) : name_(name), lines_(lines) {}

  PcdHeader read() {
    std::string line;
    Words words;
    while (lines_.next(line)) {
      split_words(line, ' ', words);
      if (words.empty() || words[0].starts_with('#')) continue;
      read_line(words);
      if (words[0] == "DATA") return finished();
    }
    throw InputError(name_, header_.fields.empty() ? "is not a PCD file" : "ends within the header");
  }

 private:
  void read_line(const Words& words) {
    const std::string_view key = words[0];
    const std::size_t n = words.size() - 1;
    if (!keys_.insert(std::string(key)).second) lines_.fail(shown(key) + " comes twice");
    if (key == "FIELDS" || key == "COLUMNS") {
      header_.fields.resize(n);
      for (std::size_t i = 0; i < n; ++i) header_.fields[i].name = words[i + 1];
    } else if (key == "SIZE" || key == "TYPE" || key == "COUNT") {
      if (n != header_.fields.size()) {
        lines_.fail(std::string(key) + " has " + std::to_string(n) + " values for " +
                    std::to_string(header_.fields.size()) + " fields");
      }
      for (std::size_t i = 0; i < n; ++i) read_property(key, words[i + 1], header_.fields[i]);
    } else if (key == "WIDTH") {
      width_ = number(words);
    } else if (key == "HEIGHT") {
      height_ = number(words);
    } else if (key == "POINTS") {
      points_ = number(words);
    } else if (key == "DATA") {
      read_data(n > 0 ? words[1] : "");
    } else if (key != "VERSION" && key != "VIEWPOINT") {
      lines_.fail("`" + shown(key) + "` is not understood");
    }
  }

  void read_property(std::string_view key, std::string_view word, PcdField& field) const {
    if (key == "TYPE") {
      if (word != "I" && word != "U" && word != "F") lines_.fail("type `" + shown(word) + "` is none of I, U and F");
      field.type = word[0];
      return;
    }
    const auto value = static_cast<std::size_t>(whole(word));
    if (key == "COUNT") {
      if (value < 1 || value > max_stride) lines_.fail("a count of " + shown(word) + " is out of range");
      field.count = value;
      return;
    }
    if (value != 1 && value != 2 && value != 4 && value != 8) {
      lines_.fail("size " + shown(word) + " is none of 1, 2, 4 and 8");
    }
    field.size = value;
  }

  void read_data(std::string_view word) {
    if (word == "ascii") {
      header_.data = PcdData::ascii;
    } else if (word == "binary") {
      header_.data = PcdData::binary;
    } else if (word == "binary_compressed") {
      header_.data = PcdData::binary_compressed;
    } else {
      lines_.fail("data `" + shown(word) + "` is none of ascii, binary and binary_compressed");
    }
  }

  std::uint64_t whole(std::string_view word) const {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size()) {
      lines_.fail("`" + shown(word) + "` is not a whole number");
    }
    return value;
  }

  std::uint64_t number(const Words& words) const {
    if (words.size() < 2) lines_.fail(shown(words[0]) + " has no value");
    return whole(words[1]);
  }

  PcdHeader finished() {
    if (header_.fields.empty()) throw InputError(name_, "header", "FIELDS is missing");
    for (PcdField& field : header_.fields) {
      if (field.type == 'F' && field.size < 4) throw InputError(name_, "header", "a float has 4 or 8 bytes");
      field.word = header_.words;
      field.offset = header_.stride;
      header_.words += field.count;
      header_.stride += field.count * field.size;
      if (header_.stride > max_stride) throw InputError(name_, "header", "a point has too many values");
    }
    std::optional<std::uint64_t> product;
    if (width_ && height_) {
      if (*height_ != 0 && *width_ > UINT64_MAX / *height_) throw InputError(name_, "header", "WIDTH is out of range");
      product = *width_ * *height_;
    }
    if (points_ && product && *points_ != *product) {
      throw InputError(name_, "header",
                       "POINTS is " + std::to_string(*points_) + ", WIDTH times HEIGHT is " + std::to_string(*product));
    }
    if (!points_ && !product) throw InputError(name_, "header", "POINTS is missing");
    header_.points = points_ ? *points_ : *product;
    return std::move(header_);
  }

  const std::string& name_;
  LineReader& lines_;
  PcdHeader header_;
  std::set<std::string> keys_;
  std::optional<std::uint64_t> width_;
  std::optional<std::uint64_t> height_;
  std::optional<std::uint64_t> points_;
};

}  // namespace

const PcdField* PcdHeader::find(const std::string& name) const {
  for (const PcdField& field : fields) {
    if (same_word(field.name, name)) return &field;
  }
  return nullptr;
}

PcdHeader read_pcd_header(const std::string& name, LineReader& lines) { return PcdHeaderReader(name, lines).read(); }

}  // namespace odosplat
