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
  std::size_t lines_before = 0;  // number of lines before the first point
  Triple point{0, 1, 2};
  bool has_names = false;              // the file names its columns
  std::optional<std::uint64_t> count;  // number of points, if the first line is a single number
  std::optional<Triple> color;
  std::optional<Triple> normal;
};

/// True if the line starts with # or // (after optional blanks), or is empty.
bool is_comment(std::string_view line);

/// Determines the layout from the first 100 points at most, by the rules given at scan_cloud. Without any point it is
/// that of x y z. Throws InputError(name, place, fault) if the meaning of the columns cannot be determined.
TextLayout find_text_layout(const std::string& name, std::istream& in);

}  // namespace odosplat
