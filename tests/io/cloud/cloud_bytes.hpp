// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/io/little_endian.hpp"

namespace odosplat::test {

/// A point of a test file; colours are in 0..255.
struct FilePoint {
  std::array<double, 3> position;
  std::array<int, 3> color;
  std::array<float, 3> normal;
};

/// Bytes of values, least significant byte first.
template <typename... T>
std::string little(T... values) {
  std::string bytes;
  (append_little(bytes, values), ...);
  return bytes;
}

/// LZF compression of any bytes, with references wherever at least 3 bytes occurred before: short, long and overlapping
/// ones.
inline std::string lzf_compress(const std::string& bytes) {
  std::string packed;
  std::string literal;
  const auto flush = [&] {
    for (std::size_t at = 0; at < literal.size(); at += 32) {
      const std::string run = literal.substr(at, 32);
      packed += static_cast<char>(run.size() - 1);
      packed += run;
    }
    literal.clear();
  };
  for (std::size_t i = 0; i < bytes.size();) {
    std::size_t best = 0;
    std::size_t distance = 0;
    for (std::size_t back = 1; back <= std::min<std::size_t>(i, 8192); ++back) {
      std::size_t length = 0;
      while (length < 264 && i + length < bytes.size() && bytes[i + length] == bytes[i + length - back]) ++length;
      if (length > best) {
        best = length;
        distance = back;
      }
    }
    if (best < 3) {
      literal += bytes[i++];
      continue;
    }
    flush();
    const std::size_t code = best - 2;
    packed += static_cast<char>(std::min<std::size_t>(code, 7) << 5 | (distance - 1) >> 8);
    if (code >= 7) packed += static_cast<char>(code - 7);
    packed += static_cast<char>((distance - 1) & 255);
    i += best;
  }
  flush();
  return packed;
}

/// Content of a LAS file; the header's counts follow from `points` unless stated otherwise.
struct LasFile {
  int minor = 2;
  int format = 3;
  std::size_t extra = 0;  // bytes after each record
  std::array<double, 3> scale{0.001, 0.001, 0.001};
  std::array<double, 3> offset{100.0, 200.0, 0.0};
  int color_factor = 257;  // 257: 16-bit colours, 1: 8-bit ones
  std::vector<FilePoint> points;
  std::uint64_t promised = UINT64_MAX;  // count in the header; UINT64_MAX: the true one
  std::size_t withheld = SIZE_MAX;      // index of a point that is marked as withheld

  std::string bytes() const {
    static constexpr std::array<std::array<std::size_t, 2>, 11> formats{
        {{20, 0}, {28, 0}, {26, 20}, {34, 28}, {57, 0}, {63, 28}, {30, 0}, {36, 30}, {38, 30}, {59, 0}, {67, 30}}};
    const auto [length, color_at] = formats[static_cast<std::size_t>(format)];
    const std::size_t header_size = minor == 4 ? 375 : minor == 3 ? 235 : 227;
    const std::uint64_t count = promised == UINT64_MAX ? points.size() : promised;
    std::string h(header_size, '\0');
    const auto put = [&h](std::size_t at, const std::string& value) { h.replace(at, value.size(), value); };
    put(0, "LASF");
    put(24, {1, static_cast<char>(minor)});
    put(94, little(static_cast<std::uint16_t>(header_size)));
    put(96, little(static_cast<std::uint32_t>(header_size + 10)));  // a gap after the header, as for a VLR
    put(104, {static_cast<char>(format)});
    put(105, little(static_cast<std::uint16_t>(length + extra)));
    if (minor < 4 || format < 6) put(107, little(static_cast<std::uint32_t>(count)));
    if (minor == 4) put(247, little(count));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      put(131 + 8 * axis, little(scale[axis]));
      put(155 + 8 * axis, little(offset[axis]));
    }
    h += std::string(10, 'g');
    for (std::size_t i = 0; i < points.size(); ++i) {
      std::string record(length, '\0');
      for (std::size_t a = 0; a < 3; ++a) {
        const double steps = (points[i].position[a] - offset[a]) / scale[a];
        record.replace(4 * a, 4, little(static_cast<std::int32_t>(steps + (steps < 0 ? -0.5 : 0.5))));
        if (color_at == 0) continue;
        record.replace(color_at + 2 * a, 2, little(static_cast<std::uint16_t>(color_factor * points[i].color[a])));
      }
      if (i == withheld) record[15] = static_cast<char>(format >= 6 ? 0x04 : 0x80);
      h += record + std::string(extra, 'x');
    }
    return h;
  }
};

/// Header of a PCD file with these fields; each argument is the rest of one line, such as fields "x y z".
inline std::string pcd_header(const std::string& fields, const std::string& size, const std::string& type,
                              const std::string& count, std::size_t points, const std::string& data) {
  return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\nFIELDS " + fields + "\nSIZE " + size + "\nTYPE " +
         type + "\nCOUNT " + count + "\nWIDTH " + std::to_string(points) + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\n" +
         "POINTS " + std::to_string(points) + "\nDATA " + data + "\n";
}

/// Data of a compressed PCD file: sizes and LZF of `columns`, which has all values of the first field, then of the
/// next.
inline std::string pcd_compressed(const std::string& columns) {
  const std::string packed = lzf_compress(columns);
  return little(static_cast<std::uint32_t>(packed.size()), static_cast<std::uint32_t>(columns.size())) + packed;
}

}  // namespace odosplat::test
