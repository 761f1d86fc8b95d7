// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace odosplat::apps {

/// Allowed values of a numeric flag: from least to most, both included unless least_excluded; never NaN or infinity.
/// word: on the command line and in help, stands for the value `meaning` ("all" for 0 threads) or for the empty value
/// of an optional number; null: no such word.
template <typename T>
struct Bounds {
  T least = std::numeric_limits<T>::lowest();
  T most = std::numeric_limits<T>::max();
  bool least_excluded = false;
  const char* word = nullptr;
  T meaning{};
};

/// Description of the bounds: "an integer from 1 to 1024", "a number above 0", "all, or an integer from 0 to 1024".
std::string words_for(const Bounds<std::int64_t>& bounds);
std::string words_for(const Bounds<std::uint64_t>& bounds);
std::string words_for(const Bounds<double>& bounds);

/// Parses the whole text as a number within the bounds. Otherwise CLI::ValidationError of one line: flag, range, text.
std::int64_t number_from(const std::string& flag, const std::string& text, const Bounds<std::int64_t>& bounds);
std::uint64_t number_from(const std::string& flag, const std::string& text, const Bounds<std::uint64_t>& bounds);
double number_from(const std::string& flag, const std::string& text, const Bounds<double>& bounds);

/// The shortest text that reads back as the same number.
std::string shortest_number_text(double value);

/// For add_numbers: no upper limit on the count.
inline constexpr int most_numbers = CLI::detail::expected_max_vector_size;

/// Type name of the flags declared here; a test checks that every numeric flag has it.
inline constexpr const char* number_type = "N";

namespace detail {

template <typename T>
using Wide = std::conditional_t<std::is_floating_point_v<T>, double,
                                std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>>;

template <typename T>
Bounds<Wide<T>> widened(const Bounds<T>& b) {
  return {b.least, b.most, b.least_excluded, b.word, b.meaning};
}

template <typename T>
T number_or_word(const std::string& flag, const std::string& text, const Bounds<T>& bounds) {
  if (bounds.word != nullptr && text == bounds.word) return bounds.meaning;
  return static_cast<T>(number_from(flag, text, widened(bounds)));
}

template <typename T>
std::string default_text(T value, const Bounds<T>& bounds) {
  if (bounds.word != nullptr && value == bounds.meaning) return bounds.word;
  if constexpr (std::is_floating_point_v<T>) {
    return shortest_number_text(value);
  } else {
    return std::to_string(value);
  }
}

}  // namespace detail

/// Declares a numeric flag. The current content of `value` is its default and shown in help.
template <typename T>
CLI::Option* add_number(CLI::App* command, const std::string& flag, T& value,
                        const Bounds<std::type_identity_t<T>>& bounds, const std::string& help) {
  CLI::Option* option = command->add_option(flag, CLI::callback_t([flag, bounds, &value](const CLI::results_t& words) {
                                              value = detail::number_or_word<T>(flag, words.back(), bounds);
                                              return true;
                                            }),
                                            help);
  return option->type_name(number_type)->default_str(detail::default_text<T>(value, bounds));
}

/// The same for an optional number; bounds.word is the default and stands for no value.
template <typename T>
CLI::Option* add_number(CLI::App* command, const std::string& flag, std::optional<T>& value,
                        const Bounds<std::type_identity_t<T>>& bounds, const std::string& help) {
  CLI::Option* option =
      command->add_option(flag, CLI::callback_t([flag, bounds, &value](const CLI::results_t& words) {
                            if (words.back() == bounds.word) {
                              value.reset();
                            } else {
                              value = static_cast<T>(number_from(flag, words.back(), detail::widened(bounds)));
                            }
                            return true;
                          }),
                          help);
  return option->type_name(number_type)->default_str(bounds.word);
}

/// The same for several numbers: `least_count` to `most_count` of them.
template <typename T>
CLI::Option* add_numbers(CLI::App* command, const std::string& flag, std::vector<T>& values, int least_count,
                         int most_count, const Bounds<std::type_identity_t<T>>& bounds, const std::string& help) {
  CLI::Option* option = command->add_option(flag, CLI::callback_t([flag, bounds, &values](const CLI::results_t& words) {
                                              values.clear();
                                              for (const std::string& word : words)
                                                values.push_back(detail::number_or_word<T>(flag, word, bounds));
                                              return true;
                                            }),
                                            help);
  std::string defaults;
  for (const T value : values) defaults += (defaults.empty() ? "" : " ") + detail::default_text<T>(value, bounds);
  return option->expected(least_count, most_count)->type_name(number_type)->default_str(defaults);
}

}  // namespace odosplat::apps
