// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "odosplat/io/cloud/cloud_columns.hpp"

namespace odosplat {

/// Columns of a text file of points, from 0.
struct TextLayout {
  using Triple = CloudColumns::Triple;

  char separator = ' ';
  std::size_t columns = 3;
  std::size_t lines_before = 0;  // the first point
  Triple point{0, 1, 2};
  bool has_names = false;              // the file names its columns
  std::optional<std::uint64_t> count;  // of points, from a first line that is one number
  std::optional<Triple> color;
  std::optional<Triple> normal;
};

/// Starts with # or // (blanks before them do not count), or holds nothing.
bool is_comment(std::string_view line);

/// Reads as far as the first 100 points to find the layout; the rules stand at scan_cloud. Without any point the layout
/// is that of x y z. InputError(name, place, fault) where the columns cannot be told.
TextLayout find_text_layout(const std::string& name, std::istream& in);

}  // namespace odosplat
