// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/number_flags.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>

namespace odosplat::apps {
namespace {

template <typename T>
std::string with_word(const Bounds<T>& bounds, const std::string& numbers) {
  return bounds.word == nullptr ? numbers : std::string(bounds.word) + ", or " + numbers;
}

template <typename T>
std::string integer_words(const Bounds<T>& bounds) {
  return with_word(bounds, "an integer from " + std::to_string(bounds.least) + " to " + std::to_string(bounds.most));
}

template <typename T>
T parsed(const std::string& flag, const std::string& text, const Bounds<T>& bounds) {
  T value{};
  const char* end = text.data() + text.size();
  const char* begin = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [rest, error] = std::from_chars(begin, end, value);
  bool good = error == std::errc() && rest == end && value >= bounds.least && value <= bounds.most &&
              !(bounds.least_excluded && value == bounds.least);
  if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
  if (!good) throw CLI::ValidationError(flag, "must be " + words_for(bounds) + ", is " + text);
  return value;
}

}  // namespace

std::string words_for(const Bounds<std::int64_t>& bounds) { return integer_words(bounds); }
std::string words_for(const Bounds<std::uint64_t>& bounds) { return integer_words(bounds); }

std::string words_for(const Bounds<double>& bounds) {
  const bool open_below = bounds.least == std::numeric_limits<double>::lowest();
  const bool open_above = bounds.most == std::numeric_limits<double>::max();
  const std::string least = shortest_number_text(bounds.least);
  const std::string most = shortest_number_text(bounds.most);
  if (open_below && open_above) return with_word(bounds, "a finite number");
  if (open_above)
    return with_word(bounds, bounds.least_excluded ? "a number above " + least : "a number of " + least + " or more");
  if (bounds.least_excluded) return with_word(bounds, "a number above " + least + " and at most " + most);
  return with_word(bounds, "a number from " + least + " to " + most);
}

std::int64_t number_from(const std::string& flag, const std::string& text, const Bounds<std::int64_t>& bounds) {
  return parsed(flag, text, bounds);
}
std::uint64_t number_from(const std::string& flag, const std::string& text, const Bounds<std::uint64_t>& bounds) {
  return parsed(flag, text, bounds);
}
double number_from(const std::string& flag, const std::string& text, const Bounds<double>& bounds) {
  return parsed(flag, text, bounds);
}

std::string shortest_number_text(double value) {
  char text[64];
  const auto [end, error] = std::to_chars(text, text + sizeof(text), value);
  return error == std::errc() ? std::string(text, end) : std::to_string(value);
}

}  // namespace odosplat::apps
