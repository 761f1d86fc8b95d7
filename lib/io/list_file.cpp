// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/list_file.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "odosplat/io/text_words.hpp"

namespace odosplat {
namespace {

bool names_color(std::string_view path) {
  return path.find("rgb") != std::string_view::npos || path.find("color") != std::string_view::npos;
}

}  // namespace

std::vector<ListedImage> parse_image_list(const std::string& name, const std::string& text) {
  std::vector<ListedImage> images;
  for_each_line(text, [&](std::size_t line, std::string_view rest) {
    const std::string_view time = take_word(rest);
    ListedImage image{word_number(name, line, time), std::string(time), std::string(rest), line};
    if (image.path.empty()) fail_line(name, line, "names no file");
    if (!images.empty() && !(image.time > images.back().time)) {
      fail_line(name, line, "time " + image.time_text + " is not after " + images.back().time_text);
    }
    images.push_back(std::move(image));
  });
  return images;
}

std::vector<ListedPair> parse_pair_list(const std::string& name, const std::string& text) {
  std::vector<ListedPair> pairs;
  for_each_line(text, [&](std::size_t line, std::string_view rest) {
    const double first_id = word_number(name, line, take_word(rest));
    const std::string_view first = take_word(rest);
    const double second_id = word_number(name, line, take_word(rest));
    const std::string_view second = take_word(rest);
    if (first.empty() || second.empty()) fail_line(name, line, "expected `id depth id color`");
    const bool color_first = names_color(first) && !names_color(second);
    ListedPair pair{second_id, std::string(second), std::string(first), line};
    if (color_first) pair = {first_id, std::string(first), std::string(second), line};
    if (!pairs.empty() && !(pair.color_id > pairs.back().color_id)) fail_line(name, line, "ids do not grow");
    pairs.push_back(std::move(pair));
  });
  return pairs;
}

std::vector<std::pair<std::size_t, std::size_t>> associate_by_time(const std::vector<double>& a,
                                                                   const std::vector<double>& b, double tolerance) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> candidates;
  std::size_t first = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    while (first < b.size() && b[first] < a[i] - tolerance) ++first;
    for (std::size_t j = first; j < b.size() && b[j] <= a[i] + tolerance; ++j) {
      candidates.emplace_back(std::abs(a[i] - b[j]), i, j);
    }
  }
  std::sort(candidates.begin(), candidates.end());
  std::vector<bool> a_used(a.size());
  std::vector<bool> b_used(b.size());
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const auto& [difference, i, j] : candidates) {
    if (a_used[i] || b_used[j]) continue;
    a_used[i] = b_used[j] = true;
    pairs.emplace_back(i, j);
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace odosplat
