// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/ply_body.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_words.hpp"

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

}  // namespace

PlyBody::PlyBody(std::string name, std::istream& in, const PlyHeader& header, std::uint64_t bytes_left)
    : name_(std::move(name)),
      in_(in),
      format_(header.format),
      line_(header.lines),
      left_(bytes_left),
      swap_((format_ == PlyFormat::binary_big_endian) == (std::endian::native == std::endian::little)) {}

void PlyBody::begin(const PlyHeaderElement& promised) {
  promised_ = &promised;
  done_ = 0;
  has_list_ = std::any_of(promised.properties.begin(), promised.properties.end(),
                          [](const PlyHeaderProperty& p) { return p.is_list; });
}

PlyElement PlyBody::next(std::uint64_t max_rows) {
  element_ = {};
  element_.name = promised_->name;
  for (const PlyHeaderProperty& p : promised_->properties) {
    if (!p.is_list) element_.properties.push_back({p.name, make_ply_column(p.type)});
  }
  if (promised_->properties.empty()) return std::move(element_);
  const std::uint64_t rows = std::min(max_rows, promised_->rows - done_);
  if (format_ == PlyFormat::ascii) {
    for (std::uint64_t row = 0; row < rows; ++row) read_ascii_row(done_ + row);
  } else if (has_list_) {
    for (std::uint64_t row = 0; row < rows; ++row) read_row_with_lists(done_ + row);
  } else {
    read_fixed_rows(rows);
  }
  done_ += rows;
  element_.count = static_cast<std::size_t>(rows);
  return std::move(element_);
}

std::string PlyBody::left_over() {
  if (promised_ == nullptr || promised_->properties.empty()) return {};
  std::string more;
  if (format_ == PlyFormat::ascii) {
    std::uint64_t lines = 0;
    while (std::getline(in_, text_)) lines += text_.find_first_not_of(blanks) == std::string::npos ? 0 : 1;
    if (lines > 0) more = std::to_string(lines) + " lines";
  } else {
    std::uint64_t stride = 0;
    for (const PlyHeaderProperty& p : promised_->properties) stride += ply_size(p.is_list ? p.length_type : p.type);
    if (left_ >= stride) {
      more = std::to_string(left_) + " bytes";
      if (!has_list_) more += ", room for " + std::to_string(left_ / stride) + " rows";
    }
  }
  if (more.empty()) return {};
  return "the header promises " + std::to_string(promised_->rows) + " rows of " + promised_->name +
         ", the file goes on for " + more + ", which are not read";
}

void PlyBody::too_short(std::uint64_t held) const {
  throw InputError(name_, "the header promises " + std::to_string(promised_->rows) + " rows of " + promised_->name +
                              ", the file holds " + std::to_string(held));
}

void PlyBody::fail(const std::string& fault) const { throw InputError(name_, "line " + std::to_string(line_), fault); }

void PlyBody::take(char* to, std::size_t n) {
  in_.read(to, static_cast<std::streamsize>(n));
  if (static_cast<std::size_t>(in_.gcount()) != n) throw InputError(name_, "cannot be read");
  left_ -= n;
}

template <typename T>
std::size_t PlyBody::spread(std::vector<T>& values, std::size_t first, std::size_t n, const char* source,
                            std::size_t stride) {
  for (std::size_t i = 0; i < n; ++i) values[first + i] = load<T>(source + i * stride, swap_);
  return sizeof(T);
}

// For rows of fixed size. Their number is checked against the file before memory is allocated.
void PlyBody::read_fixed_rows(std::uint64_t wanted) {
  std::size_t stride = 0;
  for (const PlyHeaderProperty& p : promised_->properties) stride += ply_size(p.type);
  const std::uint64_t missing = promised_->rows - done_;
  if (missing > left_ / stride) too_short(done_ + left_ / stride);
  const auto rows = static_cast<std::size_t>(wanted);
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

void PlyBody::read_row_with_lists(std::uint64_t row) {
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

std::int64_t PlyBody::list_length(PlyType type, const char* bytes) const {
  PlyColumn column = make_ply_column(type);
  return std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        return static_cast<std::int64_t>(load<T>(bytes, swap_));
      },
      column);
}

double PlyBody::number() {
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
void PlyBody::append(std::vector<T>& values) {
  const double value = number();
  if constexpr (std::is_integral_v<T>) {
    if (!(value >= std::numeric_limits<T>::min() && value <= std::numeric_limits<T>::max()) ||
        value != std::floor(value)) {
      fail("a value does not fit its type");
    }
    values.push_back(static_cast<T>(value));
  } else {
    // A finite double beyond the range of float becomes infinity, as binary writers store it.
    const auto largest = static_cast<double>(std::numeric_limits<T>::max());
    if (std::isfinite(value) && std::abs(value) > largest) {
      values.push_back(std::copysign(std::numeric_limits<T>::infinity(), static_cast<T>(value > 0 ? 1 : -1)));
    } else {
      values.push_back(static_cast<T>(value));
    }
  }
}

void PlyBody::read_ascii_row(std::uint64_t row) {
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

}  // namespace odosplat
