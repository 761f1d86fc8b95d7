// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "odosplat/core/error.hpp"
#include "odosplat/io/ply.hpp"
#include "odosplat/io/ply_header.hpp"

namespace odosplat {
namespace {

template <typename T>
T load(const char* bytes, bool swap) {
  char ordered[sizeof(T)];
  std::memcpy(ordered, bytes, sizeof(T));
  if (swap) std::reverse(ordered, ordered + sizeof(T));
  T value;
  std::memcpy(&value, ordered, sizeof(T));
  return value;
}

class BodyReader {
 public:
  BodyReader(const std::string& name, std::istream& in, const PlyHeader& header, std::uint64_t bytes_left)
      : name_(name), in_(in), format_(header.format), line_(header.lines), left_(bytes_left) {
    const bool big = format_ == PlyFormat::binary_big_endian;
    swap_ = big == (std::endian::native == std::endian::little);
  }

  PlyElement read(const PlyHeaderElement& promised) {
    promised_ = &promised;
    element_ = {};
    element_.name = promised.name;
    bool has_list = false;
    for (const PlyHeaderProperty& p : promised.properties) {
      has_list = has_list || p.is_list;
      if (!p.is_list) element_.properties.push_back({p.name, make_ply_column(p.type)});
    }
    if (!promised.properties.empty()) {
      if (format_ == PlyFormat::ascii) {
        for (std::uint64_t row = 0; row < promised.rows; ++row) read_ascii_row(row);
      } else if (has_list) {
        for (std::uint64_t row = 0; row < promised.rows; ++row) read_row_with_lists(row);
      } else {
        read_fixed_rows();
      }
    }
    // Rows without properties take no bytes, so nothing proves their number.
    element_.count = promised.properties.empty() ? 0 : static_cast<std::size_t>(promised.rows);
    return std::move(element_);
  }

 private:
  [[noreturn]] void too_short(std::uint64_t held) const {
    throw InputError(name_, "the header promises " + std::to_string(promised_->rows) + " rows of " + promised_->name +
                                ", the file holds " + std::to_string(held));
  }

  void take(char* to, std::size_t n) {
    in_.read(to, static_cast<std::streamsize>(n));
    if (static_cast<std::size_t>(in_.gcount()) != n) throw InputError(name_, "cannot be read");
    left_ -= n;
  }

  // Rows of one size: their number is checked against the file before any memory is taken.
  void read_fixed_rows() {
    std::size_t stride = 0;
    for (const PlyHeaderProperty& p : promised_->properties) stride += ply_size(p.type);
    if (promised_->rows > left_ / stride) too_short(left_ / stride);
    const auto rows = static_cast<std::size_t>(promised_->rows);
    for (PlyProperty& p : element_.properties) {
      std::visit([rows](auto& values) { values.resize(rows); }, p.values);
    }
    const std::size_t block_rows = std::max<std::size_t>(1, (std::size_t{1} << 20) / stride);
    std::vector<char> block(std::min(rows, block_rows) * stride);
    for (std::size_t first = 0; first < rows; first += block_rows) {
      const std::size_t n = std::min(block_rows, rows - first);
      take(block.data(), n * stride);
      const char* source = block.data();
      for (PlyProperty& p : element_.properties) {
        source += std::visit([&](auto& values) { return spread(values, first, n, source, stride); }, p.values);
      }
    }
  }

  template <typename T>
  std::size_t spread(std::vector<T>& values, std::size_t first, std::size_t n, const char* source, std::size_t stride) {
    for (std::size_t i = 0; i < n; ++i) values[first + i] = load<T>(source + i * stride, swap_);
    return sizeof(T);
  }

  void read_row_with_lists(std::uint64_t row) {
    std::size_t scalar = 0;
    char bytes[8];
    for (const PlyHeaderProperty& p : promised_->properties) {
      const PlyType type = p.is_list ? p.length_type : p.type;
      if (left_ < ply_size(type)) too_short(row);
      take(bytes, ply_size(type));
      if (!p.is_list) {
        std::visit(
            [&](auto& values) {
              using T = typename std::decay_t<decltype(values)>::value_type;
              values.push_back(load<T>(bytes, swap_));
            },
            element_.properties[scalar++].values);
        continue;
      }
      const std::int64_t length = list_length(type, bytes);
      if (length < 0) throw InputError(name_, "row " + std::to_string(row + 1), "a list has a negative length");
      const std::uint64_t skipped = static_cast<std::uint64_t>(length) * ply_size(p.type);
      if (left_ < skipped) too_short(row);
      in_.ignore(static_cast<std::streamsize>(skipped));
      left_ -= skipped;
    }
  }

  std::int64_t list_length(PlyType type, const char* bytes) const {
    PlyColumn column = make_ply_column(type);
    return std::visit(
        [&](const auto& values) {
          using T = typename std::decay_t<decltype(values)>::value_type;
          return static_cast<std::int64_t>(load<T>(bytes, swap_));
        },
        column);
  }

  void read_ascii_row(std::uint64_t row) {
    do {
      if (!std::getline(in_, text_)) too_short(row);
      ++line_;
    } while (text_.find_first_not_of(blanks) == std::string::npos);
    rest_ = text_;
    std::size_t scalar = 0;
    for (const PlyHeaderProperty& p : promised_->properties) {
      if (!p.is_list) {
        std::visit([&](auto& values) { append(values); }, element_.properties[scalar++].values);
        continue;
      }
      const double length = number();
      if (length < 0 || length != std::floor(length)) fail("a list's length must be a whole number");
      for (double i = 0; i < length; ++i) number();
    }
    if (rest_.find_first_not_of(blanks) != std::string_view::npos) fail("has more values than the header promises");
  }

  [[noreturn]] void fail(const std::string& fault) const {
    throw InputError(name_, "line " + std::to_string(line_), fault);
  }

  double number() {
    const std::size_t start = rest_.find_first_not_of(blanks);
    if (start == std::string_view::npos) fail("has fewer values than the header promises");
    rest_.remove_prefix(start);
    std::string_view word = rest_.substr(0, std::min(rest_.find_first_of(blanks), rest_.size()));
    rest_.remove_prefix(word.size());
    const std::string shown(word.substr(0, 24));
    if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
      fail("`" + shown + "` is out of range");
    }
    if (error != std::errc() || end != word.data() + word.size()) fail("`" + shown + "` is not a number");
    return value;
  }

  template <typename T>
  void append(std::vector<T>& values) {
    const double value = number();
    if constexpr (std::is_integral_v<T>) {
      if (!(value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max()) ||
          value != std::floor(value)) {
        fail("a value does not fit its type");
      }
      values.push_back(static_cast<T>(value));
    } else {
      // A finite double beyond float's range has no float: infinity stands for it, as binary writers do.
      const auto largest = static_cast<double>(std::numeric_limits<T>::max());
      if (std::isfinite(value) && std::abs(value) > largest) {
        values.push_back(std::copysign(std::numeric_limits<T>::infinity(), static_cast<T>(value > 0 ? 1 : -1)));
      } else {
        values.push_back(static_cast<T>(value));
      }
    }
  }

  static constexpr std::string_view blanks = " \t\r";

  const std::string& name_;
  std::istream& in_;
  PlyFormat format_;
  std::size_t line_;
  std::uint64_t left_;
  bool swap_ = false;
  const PlyHeaderElement* promised_ = nullptr;
  PlyElement element_;
  std::string text_;
  std::string_view rest_;
};

Ply read_from(const std::string& name, std::istream& in, std::uint64_t size) {
  const PlyHeader header = read_ply_header(name, in);
  BodyReader body(name, in, header, size - static_cast<std::uint64_t>(in.tellg()));
  Ply ply;
  ply.file = name;
  ply.comments = header.comments;
  for (const PlyHeaderElement& element : header.elements) ply.elements.push_back(body.read(element));
  return ply;
}

}  // namespace

Ply read_ply(const std::string& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw InputError(path, "is missing");
  if (!std::filesystem::is_regular_file(status)) throw InputError(path, "is not a file");
  std::ifstream in(path, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!in || error) throw InputError(path, "cannot be read");
  return read_from(path, in, size);
}

Ply parse_ply(const std::string& name, const std::string& bytes) {
  std::istringstream in(bytes);
  return read_from(name, in, bytes.size());
}

}  // namespace odosplat
