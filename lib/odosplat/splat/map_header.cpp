// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/map_header.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/io/text/text_rows.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

constexpr std::string_view format_words = "odosplat map, format ";
constexpr std::string_view known_format = "1";
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double most_count = std::numeric_limits<int>::max();

enum class Kind { word, real, whole };

struct HeaderField {
  std::string_view name;
  Kind kind;
  double least;
  double most;
  bool read_back;  // by MapHeader, map info and the commands that use a map
};

// The sigma factors may be at least twenty times the largest that calibration gives; with a depth share of 1, sigma is
// as large as the depth. Negative quality_depth_..., quality_color_... and quality_images_a_point mean that the value
// is unknown.
constexpr auto header_fields = std::to_array<HeaderField>({
    {"blend_order", Kind::word, 0, 0, true},
    {"dilation", Kind::real, 0.01, 100, true},
    {"compensated", Kind::whole, 0, 1, true},
    {"sigma_spread", Kind::real, 0, 100, true},
    {"sigma_slope_px", Kind::real, 0, 100, true},
    {"sigma_depth_share", Kind::real, 0, 1, true},
    {"sigma_open_share", Kind::real, 0, 100, true},
    {"quality_verdict", Kind::word, 0, 0, true},
    {"quality_psnr_db", Kind::real, -1000, 1000, true},
    {"quality_depth_error_m", Kind::real, -1, 1e6, true},
    {"quality_depth_error_share", Kind::real, -1, 1e6, true},
    {"quality_images", Kind::whole, 0, most_count, true},
    {"quality_odd_images", Kind::whole, 0, most_count, true},
    {"quality_color_inconsistency", Kind::real, -1, 1000, true},
    {"quality_unseen_share", Kind::real, 0, 1, true},
    {"quality_images_a_point", Kind::real, -1, most_count, true},
    {"quality_direction_+x", Kind::real, 0, 1, true},
    {"quality_direction_-x", Kind::real, 0, 1, true},
    {"quality_direction_+y", Kind::real, 0, 1, true},
    {"quality_direction_-y", Kind::real, 0, 1, true},
    {"quality_direction_+z", Kind::real, 0, 1, true},
    {"quality_direction_-z", Kind::real, 0, 1, true},
    {"iterations", Kind::whole, 0, most_count, false},
    {"iterations_done", Kind::whole, 0, most_count, false},
    {"seed", Kind::whole, 0, 1.8446744073709552e19, false},
    {"coarse_levels", Kind::whole, 0, 4, false},
    {"coarse_share", Kind::real, 0, 1, false},
    {"sh_interval", Kind::whole, 0, most_count, false},
    {"position_rate", Kind::real, 0, infinite, false},
    {"position_rate_final", Kind::real, 0, infinite, false},
    {"scale_rate", Kind::real, 0, infinite, false},
    {"rotation_rate", Kind::real, 0, infinite, false},
    {"opacity_rate", Kind::real, 0, infinite, false},
    {"color_rate", Kind::real, 0, infinite, false},
    {"sh_rate", Kind::real, 0, infinite, false},
    {"final_share", Kind::real, 0, 1, false},
    {"largest_growth", Kind::real, 0, infinite, false},
    {"keep_thickness", Kind::whole, 0, 1, false},
    {"ssim_weight", Kind::real, 0, 1, false},
    {"depth_weight", Kind::real, 0, infinite, false},
    {"depth_cut", Kind::real, 0, infinite, false},
    {"place_weight", Kind::real, 0, infinite, false},
    {"normal_weight", Kind::real, 0, infinite, false},
    {"flatten_weight", Kind::real, 0, infinite, false},
    {"exposure_rate", Kind::real, 0, infinite, false},
    {"budget", Kind::whole, 0, 1.8446744073709552e19, false},
    {"densify_from", Kind::whole, 0, most_count, false},
    {"densify_interval", Kind::whole, 0, most_count, false},
    {"densify_until_share", Kind::real, 0, 1, false},
    {"dead_opacity", Kind::real, 0, 1, false},
    {"densify_growth", Kind::real, 0, infinite, false},
    {"densify_pull", Kind::real, 0, infinite, false},
    {"split_size", Kind::real, 0, infinite, false},
    {"least_split_px", Kind::real, 0, infinite, false},
    {"most_split_px", Kind::real, 0, infinite, false},
    {"largest_size", Kind::real, 0, infinite, false},
    {"reset_interval", Kind::whole, 0, most_count, false},
    {"reset_opacity", Kind::real, 0, 1, false},
});

std::string printed(double value) { return formatted("%.9g", value); }

std::string range_of(const HeaderField& field) {
  const std::string kind = field.kind == Kind::whole ? "a whole number" : "a number";
  if (field.most >= most_count) return kind + " of at least " + printed(field.least);
  return kind + " in " + printed(field.least) + ".." + printed(field.most);
}

void check_value(const HeaderField& field, std::string_view text) {
  if (field.kind == Kind::word) return;
  const std::optional<double> value = number_of(text);
  const bool ok = value && *value >= field.least && *value <= field.most &&
                  (field.kind == Kind::real || *value == std::floor(*value));
  if (!ok) {
    throw InputError(std::string(field.name), "must be " + range_of(field) + ", is " + quoted_word(text));
  }
}

}  // namespace

void check_map_header(const std::vector<std::string>& comments) {
  bool is_ours = false;
  for (const std::string& comment : comments) {
    if (!comment.starts_with(format_words)) continue;
    const std::string_view format = trimmed(std::string_view(comment).substr(format_words.size()));
    if (format != known_format) {
      throw InputError("format",
                       "is " + quoted_word(format) + ", this program reads format 1: another version wrote it");
    }
    if (is_ours) throw InputError("format", "comes twice");
    is_ours = true;
  }
  std::set<std::string_view> seen;
  for (const std::string& comment : comments) {
    std::string_view rest = comment;
    const std::string_view name = take_word(rest);
    const auto field = std::find_if(header_fields.begin(), header_fields.end(),
                                    [name](const HeaderField& known) { return known.name == name; });
    if (field == header_fields.end() || !(is_ours || field->read_back)) continue;
    if (!seen.insert(field->name).second) throw InputError(std::string(name), "comes twice");
    check_value(*field, rest);
  }
}

bool names_map_setting(const std::string& comment) {
  std::string_view rest = comment;
  const std::string_view name = take_word(rest);
  return std::any_of(header_fields.begin(), header_fields.end(),
                     [name](const HeaderField& known) { return known.name == name && !known.read_back; });
}

std::optional<double> map_header_number(const std::vector<std::string>& comments, std::string_view field) {
  for (const std::string& comment : comments) {
    std::string_view rest = comment;
    if (take_word(rest) == field) return number_of(rest);
  }
  return std::nullopt;
}

}  // namespace odosplat
