// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/formatted.hpp"

#include <gtest/gtest.h>

#include <cstdarg>
#include <cstddef>
#include <limits>
#include <string>

namespace odosplat {
namespace {

[[gnu::format(printf, 2, 3)]] std::string said(const char* name, const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  std::string text = formatted_list(format, arguments);
  va_end(arguments);
  return name + (": " + text);
}

TEST(Formatted, WritesAsPrintfDoes) {
  EXPECT_EQ(formatted("%s %+d %.2f%%", "a", 7, 0.125), "a +7 0.12%");
  EXPECT_EQ(formatted("%06zu|%016llx", std::size_t{42}, 0xabcULL), "000042|0000000000000abc");
  EXPECT_EQ(formatted("%s", ""), "");
}

TEST(Formatted, KeepsLongTextWhole) {
  const std::string word(5000, 'x');
  EXPECT_EQ(formatted("<%s>%d", word.c_str(), 1), "<" + word + ">1");
  // The largest double has 309 digits before its point.
  EXPECT_EQ(formatted("%.700f", std::numeric_limits<double>::max()).size(), 309U + 1U + 700U);
}

TEST(Formatted, TakesTheArgumentsOfAnotherFunction) {
  EXPECT_EQ(said("file", "%d of %s", 3, "five"), "file: 3 of five");
  const std::string word(2000, 'y');
  EXPECT_EQ(said("file", "%s%s", word.c_str(), word.c_str()), "file: " + word + word);
}

TEST(NumberText, HasSixDigitsAndNoTrailingZeros) {
  EXPECT_EQ(number_text(0.5), "0.5");
  EXPECT_EQ(number_text(0.0), "0");
  EXPECT_EQ(number_text(-2.50), "-2.5");
  EXPECT_EQ(number_text(1e6), "1e+06");
  EXPECT_EQ(number_text(123456.0), "123456");
  EXPECT_EQ(number_text(1.0 / 3.0), "0.333333");
}

}  // namespace
}  // namespace odosplat
