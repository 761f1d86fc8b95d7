// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/foreign_map.hpp"

#include <string_view>

#include "odosplat/io/text/text_words.hpp"

namespace odosplat {

std::string joined_lines(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  for (std::string_view rest = text; !rest.empty();) {
    const std::string_view line = trimmed(take_line(rest));
    if (!line.empty()) lines.emplace_back(line);
  }
  return lines;
}

}  // namespace odosplat
