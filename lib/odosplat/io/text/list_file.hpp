// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace odosplat {

/// A line "time name" of TUM's rgb.txt and depth.txt.
struct ListedImage {
  double time = 0.0;      // [s]
  std::string time_text;  // as written
  std::string path;       // as written, relative to the list's folder
  std::size_t line = 0;   // from 1
};

/// Lines that start with # and empty lines are skipped; a name is the rest of the line and may contain blanks. Times
/// must increase. Throws InputError(name, "line N", fault) otherwise. A list without images gives an empty result.
std::vector<ListedImage> parse_image_list(const std::string& name, const std::string& text);

/// A line "id depth id color" of associations.txt. An id is a frame number (ICL-NUIM) or a time in seconds (TUM's
/// associate.py).
struct ListedPair {
  double color_id = 0.0;
  double depth_id = 0.0;
  std::string color_text;  // the ids as written
  std::string depth_text;
  std::string color_path;
  std::string depth_path;
  std::size_t line = 0;

  /// True if an id is written with a decimal point, so that the ids are times and not frame numbers.
  bool has_times() const;
};

/// The depth image comes first, as in ICL-NUIM's files, unless the first name contains "rgb" or "color". A name may
/// contain blanks if it ends in .png, .jpg or .jpeg. Ids must increase. Throws InputError(name, "line N", fault)
/// otherwise.
std::vector<ListedPair> parse_pair_list(const std::string& name, const std::string& text);

/// Pairs of indices (a, b) of times at most `tolerance` [s] apart, each used once, nearest pairs first (ties: earlier
/// first), in ascending order of a. Both lists must ascend.
std::vector<std::pair<std::size_t, std::size_t>> associate_by_time(const std::vector<double>& a,
                                                                   const std::vector<double>& b, double tolerance);

}  // namespace odosplat
