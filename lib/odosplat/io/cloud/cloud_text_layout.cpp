// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/cloud_text_layout.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/text/text_rows.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

using Words = std::vector<std::string_view>;
using Names = std::vector<std::string>;
using Triple = TextLayout::Triple;

constexpr std::size_t sample_rows = 100;

char separator_of(std::string_view line) {
  if (line.find(';') != std::string_view::npos) return ';';
  return line.find(',') != std::string_view::npos ? ',' : ' ';
}

// The words of a line without quotes and comment marks.
Names names_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of("#/ \t\r"), line.size()));
  Words words;
  split_words(line, separator_of(line), words);
  Names names;
  for (const std::string_view word : words) {
    std::string name;
    for (const char c : word) {
      if (c != '"' && c != '\'') name.push_back(c);
    }
    names.push_back(std::move(name));
  }
  return names;
}

std::optional<TextLayout> layout_of(const Names& names) {
  const CloudColumns columns = find_cloud_columns(names);
  if (!columns.point) return std::nullopt;
  TextLayout layout;
  layout.columns = names.size();
  layout.has_names = true;
  layout.point = *columns.point;
  layout.color = columns.color;
  layout.normal = columns.normal;
  return layout;
}

class LayoutFinder {
 public:
  LayoutFinder(const std::string& name, std::istream& in) : name_(name), lines_(name, in) {}

  TextLayout find() {
    std::string line;
    Words words;
    while (lines_.next(line)) {
      if (is_comment(line)) {
        if (rows_.empty() && !named_) named_ = layout_of(names_of(line));
        continue;
      }
      if (rows_.empty()) separator_ = separator_of(line);
      split_words(line, separator_, words);
      if (rows_.empty() && !number_of(words[0])) {
        read_names(line);
      } else if (rows_.empty() && words.size() == 1 && !begins_with_count_) {
        begins_with_count_ = true;
        count_ = count_of(words[0]);
        lines_before_ = lines_.number();
      } else {
        if (rows_.empty()) lines_before_ = lines_.number() - 1;
        keep(words);
        if (rows_.size() == sample_rows) break;
      }
    }
    if (rows_.empty()) return {};
    TextLayout layout = named_ ? *named_ : layout_by_number();
    layout.separator = separator_;
    layout.count = count_;
    layout.lines_before = lines_before_;
    return layout;
  }

 private:
  void read_names(const std::string& line) {
    named_ = layout_of(names_of(line));
    if (!named_) lines_.fail("neither holds numbers nor names columns x y z: `" + shown(line) + "`");
  }

  std::uint64_t count_of(std::string_view word) const {
    const double value = number_of(word).value_or(-1.0);
    if (!(value >= 0.0 && value <= 1e15) || value != std::floor(value)) {
      lines_.fail("`" + shown(word) + "` is no number of points");
    }
    return static_cast<std::uint64_t>(value);
  }

  // Values that are not numbers are reported later, by the reader.
  void keep(const Words& words) {
    std::vector<double> row;
    for (const std::string_view word : words) row.push_back(number_of(word).value_or(std::nan("")));
    rows_.push_back(std::move(row));
  }

  TextLayout layout_by_number() const {
    TextLayout layout;
    layout.columns = rows_.front().size();
    switch (layout.columns) {
      case 3:
      case 4:
        return layout;
      case 6:
        (holds_normals() ? layout.normal : layout.color) = Triple{3, 4, 5};
        return layout;
      case 7:
        if (!begins_with_count_) break;
        layout.color = Triple{4, 5, 6};
        return layout;
      case 9:
        layout.color = Triple{3, 4, 5};
        layout.normal = Triple{6, 7, 8};
        return layout;
      default:
        break;
    }
    refuse("has " + std::to_string(layout.columns) + " columns without names");
  }

  // Unit vectors with negative components are normals; without any negative component they could also be pure colours.
  bool holds_normals() const {
    bool are_unit = true;
    bool any_negative = false;
    for (const std::vector<double>& row : rows_) {
      if (row.size() != 6) continue;
      are_unit = are_unit && std::abs(std::hypot(row[3], row[4], row[5]) - 1.0) < 1e-2;
      any_negative = any_negative || std::min({row[3], row[4], row[5]}) < 0.0;
    }
    if (are_unit && !any_negative) refuse("has columns that may be colours or normals");
    return are_unit;
  }

  [[noreturn]] void refuse(const std::string& fault) const {
    throw InputError(name_, "line " + std::to_string(lines_before_ + 1),
                     fault + "; begin the file with a line of names, as in `x y z r g b`");
  }

  const std::string& name_;
  LineReader lines_;
  char separator_ = ' ';
  bool begins_with_count_ = false;
  std::optional<std::uint64_t> count_;
  std::size_t lines_before_ = 0;
  std::optional<TextLayout> named_;
  std::vector<std::vector<double>> rows_;
};

}  // namespace

bool is_comment(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  return line.empty() || line.starts_with('#') || line.starts_with("//");
}

TextLayout find_text_layout(const std::string& name, std::istream& in) { return LayoutFinder(name, in).find(); }

}  // namespace odosplat
