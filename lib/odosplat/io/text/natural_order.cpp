// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/text/natural_order.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// Removes the run of digits at the start of text and returns it without leading zeros.
std::string_view take_number(std::string_view& text) {
  std::size_t end = 0;
  while (end < text.size() && is_digit(text[end])) ++end;
  std::string_view number = text.substr(0, end);
  text.remove_prefix(end);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

}  // namespace

bool natural_less(std::string_view a, std::string_view b) {
  std::string_view rest_a = a;
  std::string_view rest_b = b;
  while (!rest_a.empty() && !rest_b.empty()) {
    if (is_digit(rest_a[0]) && is_digit(rest_b[0])) {
      const std::string_view n_a = take_number(rest_a);
      const std::string_view n_b = take_number(rest_b);
      if (n_a.size() != n_b.size()) return n_a.size() < n_b.size();
      if (n_a != n_b) return n_a < n_b;
    } else {
      if (rest_a[0] != rest_b[0]) {
        return static_cast<unsigned char>(rest_a[0]) < static_cast<unsigned char>(rest_b[0]);
      }
      rest_a.remove_prefix(1);
      rest_b.remove_prefix(1);
    }
  }
  if (rest_a.empty() != rest_b.empty()) return rest_a.empty();
  return a < b;
}

std::vector<std::string> list_folder(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code error;
  std::vector<std::string> names;
  for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
    if (std::string name = it->path().filename().string(); !name.starts_with('.')) names.push_back(std::move(name));
  }
  if (error) throw InputError(folder, "cannot be listed: " + error.message());
  std::sort(names.begin(), names.end(), natural_less);
  return names;
}

long long number_in(std::string_view stem) {
  std::size_t end = stem.size();
  while (end > 0 && !is_digit(stem[end - 1])) --end;
  std::size_t start = end;
  while (start > 0 && is_digit(stem[start - 1])) --start;
  if (start == end || end - start > 15) return -1;
  long long number = 0;
  for (std::size_t i = start; i < end; ++i) number = 10 * number + (stem[i] - '0');
  return number;
}

}  // namespace odosplat
