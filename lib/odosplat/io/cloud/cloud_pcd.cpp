// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// PCD: "The PCD (Point Cloud Data) file format", documentation of the Point Cloud Library, versions 0.5 to 0.7. Binary
// values are little endian; compressed files store all values of one field after those of another, not point by point.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>

#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud/cloud_columns.hpp"
#include "odosplat/io/cloud/cloud_source.hpp"
#include "odosplat/io/cloud/lzf.hpp"
#include "odosplat/io/cloud/pcd_header.hpp"
#include "odosplat/io/little_endian.hpp"

namespace odosplat {
namespace {

using Fields = std::vector<PcdField>;

double load_value(const char* bytes, const PcdField& field) {
  if (field.type == 'F') return field.size == 4 ? load_little<float>(bytes) : load_little<double>(bytes);
  const bool is_signed = field.type == 'I';
  switch (field.size) {
    case 1:
      return is_signed ? load_little<std::int8_t>(bytes) : load_little<std::uint8_t>(bytes);
    case 2:
      return is_signed ? load_little<std::int16_t>(bytes) : load_little<std::uint16_t>(bytes);
    case 4:
      return is_signed ? static_cast<double>(load_little<std::int32_t>(bytes))
                       : static_cast<double>(load_little<std::uint32_t>(bytes));
    default:
      return is_signed ? static_cast<double>(load_little<std::int64_t>(bytes))
                       : static_cast<double>(load_little<std::uint64_t>(bytes));
  }
}

Eigen::Vector3f unpack(std::uint32_t rgb) {
  return {static_cast<float>(rgb >> 16 & 255U), static_cast<float>(rgb >> 8 & 255U), static_cast<float>(rgb & 255U)};
}

ColorRange range_of(const PcdField& field) {
  return {field.type == 'F' ? 1.0F : 255.0F, field.size > 1 ? 65535.0F : 255.0F};
}

class PcdSource : public CloudSource {
 public:
  explicit PcdSource(CloudInput input) : input_(std::move(input)), lines_(input_.name, *input_.in) {
    header_ = read_pcd_header(input_.name, lines_);
    left_ = header_.points;
    std::vector<std::string> names;
    for (const PcdField& field : header_.fields) names.push_back(field.name);
    const CloudColumns columns = find_cloud_columns(names);
    if (!columns.point) throw InputError(input_.name, "header", "has no fields x y z");
    want(*columns.point);
    const PcdField* packed = header_.find("rgb");
    if (packed == nullptr) packed = header_.find("rgba");
    has_packed_ = packed != nullptr;
    if (has_packed_) {
      fields_.push_back(*packed);
      if (fields_.back().size != 4) throw InputError(input_.name, "header", "packed colours have 4 bytes");
      range_ = ColorRange{};
    } else if (columns.color) {
      want(*columns.color);
      range_ = ColorRange{0.0F, 0.0F};
      for (std::size_t i = 3; i < 6; ++i) {
        range_->low = std::max(range_->low, range_of(fields_[i]).low);
        range_->high = std::max(range_->high, range_of(fields_[i]).high);
      }
    }
    has_normals_ = columns.normal.has_value();
    if (has_normals_) want(*columns.normal);
    if (header_.data == PcdData::binary) require_points();
    if (header_.data == PcdData::binary_compressed) open_streams();
  }

  bool next(CloudRows& rows) override {
    rows.clear();
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(left_, batch_rows));
    if (n == 0) return false;
    switch (header_.data) {
      case PcdData::ascii:
        for (std::size_t i = 0; i < n; ++i) read_line(header_.points - left_ + i, rows);
        break;
      case PcdData::binary:
        read_records(n, rows);
        break;
      case PcdData::binary_compressed:
        read_streams(n, rows);
        break;
    }
    left_ -= n;
    return true;
  }

  std::optional<ColorRange> color_range() const override { return range_; }

  std::string left_over() override {
    std::string more;
    if (header_.data == PcdData::ascii) {
      std::uint64_t lines = 0;
      for (; lines_.next(line_); lines += words_.empty() ? 0 : 1) split_words(line_, ' ', words_);
      if (lines > 0) more = std::to_string(lines) + " lines";
    } else {
      const std::uint64_t points =
          header_.data == PcdData::binary ? bytes_left() / header_.stride : whole_ / header_.stride - header_.points;
      if (points > 0) more = std::to_string(points) + " more";
    }
    if (more.empty()) return {};
    return "the header promises " + std::to_string(header_.points) + " points, the file goes on for " + more +
           ", which are not read";
  }

 private:
  // Values of one point in the order of the wanted fields; a packed colour as an integer with its bits.
  using Values = std::array<double, 9>;

  void want(const CloudColumns::Triple& columns) {
    for (const std::size_t column : columns) fields_.push_back(header_.fields[column]);
  }

  bool is_packed(std::size_t field) const { return has_packed_ && field == 3; }

  double load(const char* bytes, std::size_t field) const {
    return is_packed(field) ? load_little<std::uint32_t>(bytes) : load_value(bytes, fields_[field]);
  }

  void append(const Values& v, CloudRows& rows) const {
    rows.points.emplace_back(v[0], v[1], v[2]);
    std::size_t at = 3;
    if (has_packed_) {
      rows.colors.push_back(unpack(static_cast<std::uint32_t>(v[at++])));
    } else if (range_) {
      rows.colors.emplace_back(static_cast<float>(v[at]), static_cast<float>(v[at + 1]), static_cast<float>(v[at + 2]));
      at += 3;
    }
    if (has_normals_)
      rows.normals.emplace_back(static_cast<float>(v[at]), static_cast<float>(v[at + 1]),
                                static_cast<float>(v[at + 2]));
  }

  [[noreturn]] void too_short(std::uint64_t held) const {
    throw InputError(input_.name, "the header promises " + std::to_string(header_.points) + " points, the file holds " +
                                      std::to_string(held));
  }

  std::uint64_t bytes_left() { return input_.size - static_cast<std::uint64_t>(input_.in->tellg()); }

  void require_points() {
    const std::uint64_t held = bytes_left() / header_.stride;
    if (held < header_.points) too_short(held);
  }

  void read_line(std::uint64_t row, CloudRows& rows) {
    do {
      if (!lines_.next(line_)) too_short(row);
      split_words(line_, ' ', words_);
    } while (words_.empty());
    if (words_.size() != header_.words) {
      lines_.fail("has " + std::to_string(words_.size()) + " values, the header promises " +
                  std::to_string(header_.words));
    }
    Values values{};
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const std::string_view word = words_[fields_[i].word];
      values[i] = is_packed(i) ? packed_of(word, fields_[i]) : value_of(word);
    }
    append(values, rows);
  }

  double value_of(std::string_view word) const {
    const std::optional<double> value = number_of(word);
    if (!value) lines_.fail("`" + shown(word) + "` is not a number");
    return *value;
  }

  // In a float field the bits are the colour. NaN is read as black: writers of organised clouds leave it in holes.
  double packed_of(std::string_view word, const PcdField& field) const {
    if (field.type == 'F') {
      float value = 0.0F;
      const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
      if (error == std::errc() && end == word.data() + word.size()) {
        return value == value ? std::bit_cast<std::uint32_t>(value) : 0U;
      }
    }
    const double value = value_of(word);
    if (!(value >= -2147483648.0 && value <= 4294967295.0)) lines_.fail("`" + shown(word) + "` is no packed colour");
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  }

  void read_records(std::size_t n, CloudRows& rows) {
    Values values{};
    const std::size_t piece = std::max<std::size_t>(1, (std::size_t{1} << 22) / header_.stride);
    for (std::size_t first = 0; first < n; first += piece) {
      const std::size_t count = std::min(piece, n - first);
      block_.resize(count * header_.stride);
      input_.take(block_.data(), block_.size());
      for (const char* row = block_.data(); row != block_.data() + block_.size(); row += header_.stride) {
        for (std::size_t i = 0; i < fields_.size(); ++i) values[i] = load(row + fields_[i].offset, i);
        append(values, rows);
      }
    }
  }

  // One pass finds where each wanted field starts; each field is then read by its own stream from there.
  void open_streams() {
    std::array<char, 8> sizes{};
    if (bytes_left() < sizes.size()) too_short(0);
    input_.take(sizes.data(), sizes.size());
    const std::uint64_t packed = load_little<std::uint32_t>(sizes.data());
    const std::uint64_t whole = load_little<std::uint32_t>(sizes.data() + 4);
    if (packed > bytes_left()) {
      throw InputError(input_.name, "the header promises " + std::to_string(packed) +
                                        " compressed bytes, the file holds " + std::to_string(bytes_left()));
    }
    if (whole / header_.stride < header_.points) too_short(whole / header_.stride);
    whole_ = whole;
    const auto begin = static_cast<std::uint64_t>(input_.in->tellg());
    LzfStream stream(input_.name, *input_.in, begin, begin + packed);
    streams_.assign(fields_.size(), stream);
    for (const PcdField& field : header_.fields) {
      for (std::size_t i = 0; i < fields_.size(); ++i) {
        if (fields_[i].offset == field.offset) streams_[i] = stream;
      }
      // No overflow: points * stride is at most `whole`, which is below 2^32.
      stream.read(nullptr, static_cast<std::size_t>(header_.points) * field.count * field.size);
    }
  }

  void read_streams(std::size_t n, CloudRows& rows) {
    std::vector<Values> values(n);
    for (std::size_t i = 0; i < fields_.size(); ++i) {
      const std::size_t step = fields_[i].count * fields_[i].size;
      block_.resize(step);
      for (Values& v : values) {
        streams_[i].read(block_.data(), step);
        v[i] = load(block_.data(), i);
      }
    }
    for (const Values& v : values) append(v, rows);
  }

  CloudInput input_;
  LineReader lines_;
  PcdHeader header_;
  Fields fields_;  // x y z, then colours, then normals
  bool has_packed_ = false;
  bool has_normals_ = false;
  std::optional<ColorRange> range_;
  std::uint64_t left_ = 0;
  std::uint64_t whole_ = 0;  // compressed files: size of the decompressed points [bytes]
  std::string line_;
  std::vector<std::string_view> words_;
  std::vector<char> block_;
  std::vector<LzfStream> streams_;
};

}  // namespace

std::unique_ptr<CloudSource> open_pcd_source(CloudInput input) { return std::make_unique<PcdSource>(std::move(input)); }

}  // namespace odosplat
