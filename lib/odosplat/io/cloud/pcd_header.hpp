// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/io/text/text_rows.hpp"

namespace odosplat {

enum class PcdData { ascii, binary, binary_compressed };

struct PcdField {
  std::string name;
  std::size_t size = 4;  // [bytes] of a value: 1, 2, 4 or 8
  char type = 'F';       // I, U or F
  std::size_t count = 1;
  std::size_t word = 0;    // index of its first value in a row
  std::size_t offset = 0;  // [bytes] of its first value in a row
};

/// Header of a PCD file (Point Cloud Library, versions 0.5 to 0.7).
struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t points = 0;  // number declared in the header
  PcdData data = PcdData::ascii;
  std::size_t words = 0;   // values of a row
  std::size_t stride = 0;  // [bytes] of a row in binary files

  /// The field of that name in upper or lower case; nullptr if there is none.
  const PcdField* find(const std::string& name) const;
};

/// Reads up to and including the line DATA. SIZE, TYPE and COUNT may be absent (defaults 4, F, 1); the number of points
/// is POINTS, else WIDTH times HEIGHT. Throws InputError naming the line for any other header.
PcdHeader read_pcd_header(const std::string& name, LineReader& lines);

}  // namespace odosplat
