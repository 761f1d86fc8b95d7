// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/text/list_file.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <tuple>

#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

constexpr std::array<std::string_view, 3> image_endings{".png", ".jpg", ".jpeg"};

bool names_color(std::string_view path) {
  return path.find("rgb") != std::string_view::npos || path.find("color") != std::string_view::npos;
}

bool names_image(std::string_view name) {
  return std::any_of(image_endings.begin(), image_endings.end(), [&](std::string_view ending) {
    return name.size() > ending.size() && same_word(name.substr(name.size() - ending.size()), ending);
  });
}

bool is_number(std::string_view word) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

// The first name of a pair: up to the first word that ends in an image extension and is followed by a number and more;
// else one word.
std::string_view take_first_name(std::string_view& rest) {
  const std::string_view all = rest;
  while (!rest.empty()) {
    const std::string_view word = take_word(rest);
    std::string_view behind = rest;
    if (!names_image(word) || !is_number(take_word(behind)) || behind.empty()) continue;
    return all.substr(0, static_cast<std::size_t>(word.data() - all.data()) + word.size());
  }
  rest = all;
  return take_word(rest);
}

}  // namespace

std::vector<ListedImage> parse_image_list(const std::string& name, const std::string& text) {
  std::vector<ListedImage> images;
  for_each_line(name, text, [&](std::size_t line, std::string_view rest) {
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

bool ListedPair::has_times() const {
  return color_text.find('.') != std::string::npos || depth_text.find('.') != std::string::npos;
}

std::vector<ListedPair> parse_pair_list(const std::string& name, const std::string& text) {
  std::vector<ListedPair> pairs;
  for_each_line(name, text, [&](std::size_t line, std::string_view rest) {
    const std::string_view first_id = take_word(rest);
    word_number(name, line, first_id);
    const std::string_view first = take_first_name(rest);
    const std::string_view second_id = take_word(rest);
    word_number(name, line, second_id);
    const std::string_view second = rest;
    if (first.empty() || second.empty()) fail_line(name, line, "expected `id depth id color`");
    if (second.find_first_of(" \t") != std::string_view::npos && !names_image(second)) {
      fail_line(name, line, "has more than `id depth id color`");
    }
    ListedPair pair;
    pair.line = line;
    const bool color_first = names_color(first) && !names_color(second);
    pair.color_text = color_first ? first_id : second_id;
    pair.depth_text = color_first ? second_id : first_id;
    pair.color_path = color_first ? first : second;
    pair.depth_path = color_first ? second : first;
    pair.color_id = word_number(name, line, pair.color_text);
    pair.depth_id = word_number(name, line, pair.depth_text);
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
