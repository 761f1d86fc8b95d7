// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/euroc_csv.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/io/text/text_words.hpp"

namespace odosplat {
namespace {

using Words = std::vector<std::string_view>;

constexpr std::int64_t nanoseconds = 1'000'000'000;
constexpr std::size_t table_width = 17;
constexpr std::size_t pose_width = 8;
constexpr std::size_t epoch_digits = 16;  // nanoseconds since 1970, or since any start more than four months ago

Words split(std::string_view line) {
  Words words;
  while (true) {
    const std::size_t end = std::min(line.find(','), line.size());
    words.push_back(trimmed(line.substr(0, end)));
    if (end == line.size()) return words;
    line.remove_prefix(end + 1);
  }
}

bool is_whole(std::string_view word) {
  return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string lower(std::string_view word) {
  std::string text(word);
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

// Column whose heading names that component of the quaternion: "q_RS_w []", "qw", "q_w".
std::size_t column_of(const Words& heading, char part) {
  for (std::size_t i = 0; i < heading.size(); ++i) {
    const std::string name = lower(heading[i].substr(0, heading[i].find(' ')));
    if (name.size() > 1 && name.front() == 'q' && name.back() == part) return i;
  }
  return heading.size();
}

struct Heading {
  bool nanoseconds = false;
  bool w_last = false;
};

Heading heading_of(std::string_view comment) {
  comment.remove_prefix(1);
  const Words names = split(comment);
  const std::size_t w = column_of(names, 'w');
  const std::size_t x = column_of(names, 'x');
  return {lower(names.front()).find("[ns]") != std::string::npos, w < names.size() && x < w};
}

// Calls visit(line number, words of the line, whether it is a comment) until it returns false.
template <typename Visit>
void each_line(std::string_view text, Visit visit) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // a byte-order mark
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string_view line = trimmed(take_line(text));
    if (!line.empty() && !visit(number, line, line.front() == '#')) return;
  }
}

std::int64_t whole_time(const std::string& name, std::size_t line, std::string_view word) {
  std::int64_t time = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), time);
  if (error != std::errc() || end != word.data() + word.size()) {
    fail_line(name, line, quoted_word(word) + " is not a time in whole nanoseconds");
  }
  return time;
}

std::string seconds_text(std::int64_t time) {
  return formatted("%s%lld.%09lld", time < 0 ? "-" : "", static_cast<long long>(std::abs(time / nanoseconds)),
                   static_cast<long long>(std::abs(time % nanoseconds)));
}

}  // namespace

bool is_euroc_csv(std::string_view text) {
  Heading heading;
  bool euroc = false;
  each_line(text, [&](std::size_t, std::string_view line, bool comment) {
    if (comment) {
      const Heading found = heading_of(line);
      if (found.nanoseconds) heading = found;
      return true;
    }
    const Words words = split(line);
    euroc = is_whole(words.front()) &&
            (words.size() == table_width ||
             (words.size() == pose_width && (heading.nanoseconds || words.front().size() >= epoch_digits)));
    return false;
  });
  return euroc;
}

Trajectory parse_euroc_csv(const std::string& name, std::string_view text) {
  Trajectory trajectory;
  bool w_last = false;
  std::size_t width = 0;
  std::int64_t last = 0;
  each_line(text, [&](std::size_t number, std::string_view line, bool comment) {
    if (comment) {
      w_last = w_last || heading_of(line).w_last;
      return true;
    }
    const Words words = split(line);
    if (width == 0) width = words.size();
    if (words.size() != width) {
      fail_line(name, number,
                "has " + std::to_string(words.size()) + " values, the lines before have " + std::to_string(width));
    }
    const std::int64_t time = whole_time(name, number, words[0]);
    double v[pose_width] = {};
    for (std::size_t i = 1; i < width; ++i) {
      const double value = word_number(name, number, words[i]);
      if (i < pose_width) v[i] = value;
    }
    const Eigen::Quaterniond q =
        w_last ? Eigen::Quaterniond(v[7], v[4], v[5], v[6]) : Eigen::Quaterniond(v[4], v[5], v[6], v[7]);
    SE3 pose;
    try {
      pose = SE3(rotation_from_text(q), Eigen::Vector3d(v[1], v[2], v[3]));
    } catch (const InputError& e) {
      fail_line(name, number, e.what());
    }
    if (!trajectory.empty() && time < last) {
      fail_line(name, number, "time " + std::string(words[0]) + " is before " + std::to_string(last));
    }
    last = time;
    trajectory.push_back({static_cast<double>(time) / static_cast<double>(nanoseconds), pose, seconds_text(time)});
    return true;
  });
  return trajectory;
}

}  // namespace odosplat
