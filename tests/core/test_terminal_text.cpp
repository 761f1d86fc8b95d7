// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat {
namespace {

using namespace std::string_literals;
using testing::HasSubstr;
using testing::Not;

TEST(TerminalText, ControlCharactersAreShownAsBytes) {
  EXPECT_EQ(printable_line("a\x1b[31mb"), "a\\x1b[31mb");
  EXPECT_EQ(printable_line("\a\r\x7f\0z"s), "\\x07\\x0d\\x7f\\x00z");
  EXPECT_EQ(printable_line("two\nlines\tand a tab"), "two\\x0alines\\x09and a tab");
  // CSI as one character (U+009B), and one that reverses the direction of writing (U+202E).
  EXPECT_EQ(printable_line("\u009b31m"), "\\xc2\\x9b31m");
  EXPECT_EQ(printable_line("\u202egnp.exe"), "\\xe2\\x80\\xaegnp.exe");
}

TEST(TerminalText, LinesAreKeptWhereTextHasThem) {
  EXPECT_EQ(printable_text("one\n\ttwo\r\n\x1b"), "one\n\ttwo\\x0d\n\\x1b");
}

TEST(TerminalText, Utf8StaysAndWhatIsNoneIsEscaped) {
  EXPECT_EQ(printable_line("Büro 東京 🎥"), "Büro 東京 🎥");
  EXPECT_EQ(printable_line("B\xfcro"), "B\\xfcro");              // Latin-1
  EXPECT_EQ(printable_line("\xe6\x9d"), "\\xe6\\x9d");           // truncated
  EXPECT_EQ(printable_line("\xc0\xaf"), "\\xc0\\xaf");           // overlong encoding
  EXPECT_EQ(printable_line("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // surrogate
  EXPECT_EQ(printable_line("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(TerminalText, EveryByteComesOutPrintable) {
  for (int first = 0; first < 256; ++first) {
    for (int second = 0; second < 256; ++second) {
      const std::string out = printable_line(std::string{static_cast<char>(first), static_cast<char>(second)});
      for (const char c : out)
        ASSERT_TRUE(static_cast<unsigned char>(c) >= 0x20 && c != '\x7f') << first << " " << second;
      EXPECT_EQ(printable_line(out), out);
    }
  }
}

TEST(TerminalText, ColumnsAreCountedAndCut) {
  EXPECT_EQ(text_columns("Büro"), 4);
  EXPECT_EQ(text_columns("東京"), 4);
  EXPECT_EQ(text_columns("e\u0301"), 1);
  EXPECT_EQ(cut_to_columns("abcdef", 6), "abcdef");
  EXPECT_EQ(cut_to_columns("abcdef", 4), "abc…");
  EXPECT_EQ(cut_to_columns("東京駅", 5), "東京…");
  EXPECT_EQ(cut_to_columns("東京駅", 4), "東…");
  EXPECT_EQ(cut_to_columns("abc", 0), "");
}

TEST(TerminalText, QuotedTextIsCutAndTheRestOfTheLineStays) {
  const std::string token(100000, 'x');
  const std::string cut = token.substr(0, 97).append("...");
  EXPECT_EQ(printable_line("f.txt: line 3: `" + token + "` is not a number"),
            "f.txt: line 3: `" + cut + "` is not a number");
  EXPECT_EQ(printable_line("--start: is \"" + token + "\", \"b\""), "--start: is \"" + cut + "\", \"b\"");
  // At most 100 bytes are kept; the cut is between characters.
  const std::string whole(100, 'y');
  EXPECT_EQ(printable_line("\"" + whole + "\""), "\"" + whole + "\"");
  std::string umlauts;
  for (int i = 0; i < 60; ++i) umlauts += "\u00fc";
  EXPECT_EQ(printable_line("`" + umlauts + "`"), "`" + umlauts.substr(0, 96) + "...`");
  // Paths without quotes are kept; they may have 4096 bytes.
  const std::string path = "/" + std::string(4094, 'p');
  EXPECT_EQ(printable_line(path + ": is missing"), path + ": is missing");
  EXPECT_EQ(printable_line("a lone \" mark"), "a lone \" mark");
  const std::string line = printable_line("start " + token + " end");
  EXPECT_LE(line.size(), 8100U);
  EXPECT_TRUE(line.starts_with("start xxx") && line.ends_with("xxx end"));
}

TEST(InputError, AZeroByteDoesNotEndTheLine) {
  const InputError error("f.txt", std::string("`a\0b` is not a number", 21));
  EXPECT_STREQ(error.what(), "f.txt: `a\\x00b` is not a number");
}

TEST(InputError, QuotedLineEndsDoNotBreakTheLine) {
  const std::string longer(200, 'k');
  EXPECT_EQ(InputError("f.yaml", longer + "\nlines", "is not a known key").what(),
            "f.yaml: " + longer + "\\x0alines: is not a known key");
  EXPECT_EQ(InputError(InputError("f.txt", "a\tb `" + longer + "`").what()).what(),
            "f.txt: a\\x09b `" + longer + "`");  // as it was: it is cut when it is shown
}

TEST(Log, ShowsNoControlCharactersOfFiles) {
  testing::internal::CaptureStderr();
  log_warning("rgb/\x1b]0;title\a\r.png");
  const std::string shown = testing::internal::GetCapturedStderr();
  EXPECT_THAT(shown, HasSubstr("rgb/\\x1b]0;title\\x07\\x0d.png"));
  EXPECT_THAT(shown, Not(HasSubstr("\x1b")));
}

TEST(Log, SaysWhetherItShowsInformation) {
  set_log_level("warning");
  EXPECT_FALSE(logs_info());
  set_log_level("info");
  EXPECT_TRUE(logs_info());
}

}  // namespace
}  // namespace odosplat
