// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// LAS: "LAS Specification", ASPRS, versions 1.0 to 1.4 (R15). All values are little endian.
#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/io/cloud/cloud_source.hpp"
#include "odosplat/io/little_endian.hpp"

namespace odosplat {
namespace {

struct PointFormat {
  std::size_t length;  // shortest record [bytes]
  std::size_t color;   // offset of red, green, blue in it; 0: none
};

constexpr std::array<PointFormat, 11> point_formats{
    {{20, 0}, {28, 0}, {26, 20}, {34, 28}, {57, 0}, {63, 28}, {30, 0}, {36, 30}, {38, 30}, {59, 0}, {67, 30}}};

class LasSource : public CloudSource {
 public:
  explicit LasSource(CloudInput input) : input_(std::move(input)) {
    std::array<char, 375> header{};  // size in version 1.4; earlier headers are shorter
    input_.in->read(header.data(), header.size());
    const auto held = static_cast<std::size_t>(input_.in->gcount());
    input_.in->clear();
    const char* h = header.data();
    if (held < 4 || std::string(h, 4) != "LASF") throw InputError(input_.name, "is not a LAS file");
    if (held < 227) throw InputError(input_.name, "ends within the header");
    read_version(h);
    const int minor = static_cast<unsigned char>(h[25]);
    if (minor == 4 && held < header.size()) throw InputError(input_.name, "ends within the header");
    const int packed = static_cast<unsigned char>(h[104]);
    if ((packed & 0xC0) != 0) {
      throw InputError(input_.name, "is compressed (LAZ); decompress it first, as with laszip or pdal translate");
    }
    if (packed >= static_cast<int>(point_formats.size()))
      fail("point format " + std::to_string(packed) + " is unknown");
    format_ = point_formats[static_cast<std::size_t>(packed)];
    is_extended_ = packed >= 6;
    length_ = load_little<std::uint16_t>(h + 105);
    if (length_ < format_.length) {
      fail("a record of point format " + std::to_string(packed) + " has at least " + std::to_string(format_.length) +
           " bytes, here " + std::to_string(length_));
    }
    left_ = load_little<std::uint32_t>(h + 107);
    if (minor == 4 && load_little<std::uint64_t>(h + 247) > 0) left_ = load_little<std::uint64_t>(h + 247);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scale_[axis] = load_little<double>(h + 131 + 8 * axis);
      offset_[axis] = load_little<double>(h + 155 + 8 * axis);
      if (!std::isfinite(scale_[axis]) || scale_[axis] == 0.0) fail("a scale is zero or not finite");
      if (!std::isfinite(offset_[axis])) fail("an offset is not finite");
    }
    const auto header_size = load_little<std::uint16_t>(h + 94);
    // Data that may follow the points: waveforms since version 1.3, extended variable length records since 1.4.
    end_ = input_.size;
    for (const std::size_t at : {std::size_t{227}, std::size_t{235}}) {
      if (minor < (at == 227 ? 3 : 4) || header_size < at + 8) continue;
      if (const auto start = load_little<std::uint64_t>(h + at); start > 0) end_ = std::min(end_, start);
    }
    seek_points(load_little<std::uint32_t>(h + 96), header_size);
    const std::uint64_t legacy = load_little<std::uint32_t>(h + 107);
    if (minor == 4 && legacy > 0 && legacy != promised_) {
      fail("its two counts of points are " + std::to_string(legacy) + " and " + std::to_string(promised_));
    }
  }

  bool next(CloudRows& rows) override {
    rows.clear();
    if (left_ == 0) return false;
    const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(left_, batch_rows));
    block_.resize(n * length_);
    input_.take(block_.data(), block_.size());
    left_ -= n;
    for (std::size_t i = 0; i < n; ++i) {
      const char* record = block_.data() + i * length_;
      if (is_withheld(record)) continue;
      rows.points.emplace_back(coordinate(record, 0), coordinate(record, 1), coordinate(record, 2));
      if (format_.color == 0) continue;
      const char* color = record + format_.color;
      rows.colors.emplace_back(load_little<std::uint16_t>(color), load_little<std::uint16_t>(color + 2),
                               load_little<std::uint16_t>(color + 4));
    }
    return true;
  }

  std::string left_over() override {
    if (more_ == 0) return {};
    return "the header promises " + std::to_string(promised_) + " points, the file goes on for " +
           std::to_string(more_) + " more, which are not read";
  }

  std::optional<ColorRange> color_range() const override {
    if (format_.color == 0) return std::nullopt;
    return ColorRange{255.0F, 65535.0F, true};
  }

 private:
  [[noreturn]] void fail(const std::string& fault) const { throw InputError(input_.name, "header", fault); }

  void read_version(const char* h) const {
    if (h[24] == 1 && h[25] >= 0 && h[25] <= 4) return;
    fail("LAS version " + std::to_string(static_cast<unsigned char>(h[24])) + "." +
         std::to_string(static_cast<unsigned char>(h[25])) + " is unknown (1.0 to 1.4 are read)");
  }

  void seek_points(std::uint64_t start, std::uint64_t header_size) {
    if (header_size < 227) fail("its own size is " + std::to_string(header_size) + ", must be at least 227");
    if (start < header_size || start > input_.size) {
      fail("points start at byte " + std::to_string(start) + ", outside the file's data");
    }
    const std::uint64_t held = (input_.size - start) / length_;
    if (left_ > held) {
      throw InputError(input_.name, "the header promises " + std::to_string(left_) + " points, the file holds " +
                                        std::to_string(held));
    }
    input_.in->seekg(static_cast<std::streamoff>(start));
    promised_ = left_;
    more_ = end_ > start + left_ * length_ ? (end_ - start) / length_ - left_ : 0;
  }

  double coordinate(const char* record, std::size_t axis) const {
    return load_little<std::int32_t>(record + 4 * axis) * scale_[axis] + offset_[axis];
  }

  // Withheld points are deleted ones that remain in the file.
  bool is_withheld(const char* record) const { return (record[15] & (is_extended_ ? 0x04 : 0x80)) != 0; }

  CloudInput input_;
  PointFormat format_{};
  bool is_extended_ = false;
  std::size_t length_ = 0;  // length of a record [bytes]
  std::uint64_t left_ = 0;
  std::uint64_t promised_ = 0;
  std::uint64_t more_ = 0;  // number of further records for which the file has room
  std::uint64_t end_ = 0;   // end of the part of the file that may contain points [bytes]
  std::array<double, 3> scale_{};
  std::array<double, 3> offset_{};
  std::vector<char> block_;
};

}  // namespace

std::unique_ptr<CloudSource> open_las_source(CloudInput input) { return std::make_unique<LasSource>(std::move(input)); }

}  // namespace odosplat
