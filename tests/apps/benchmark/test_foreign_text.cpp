// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/foreign_text.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/apps/run_program.hpp"

namespace odosplat::apps {
namespace {

using apps_test::ScratchFolder;
using apps_test::write_text;

TEST(ForeignText, KeepsWhatIsUtf8) {
  for (const std::string text : {"", "plain", "caf\xc3\xa9 \xe2\x82\xac \xf0\x9f\x98\x80"})
    EXPECT_EQ(clean_text(text), text);
}

TEST(ForeignText, MarksWhatIsNot) {
  EXPECT_EQ(clean_text("caf\xe9"), "caf?");
  EXPECT_EQ(clean_text("caf\xe9!"), "caf?!");
  EXPECT_EQ(clean_text("\xe2\x82"), "??");            // truncated character
  EXPECT_EQ(clean_text("\xc0\xaf"), "??");            // overlong encoding of a slash
  EXPECT_EQ(clean_text("\xed\xa0\x80"), "???");       // a surrogate
  EXPECT_EQ(clean_text("\xf4\x90\x80\x80"), "????");  // beyond U+10FFFF
  EXPECT_EQ(clean_text(std::string("a\0b", 3)), "a?b");
}

TEST(ForeignText, ObeysNoTerminal) {
  EXPECT_EQ(clean_text("\x1b[2J\x07\r\n\x7f"), "?[2J????");
  EXPECT_EQ(clean_text("\xc2\x9b"
                       "2J"),
            "?2J");
}

TEST(ForeignText, IsCutBetweenCharacters) {
  const std::string euro = "\xe2\x82\xac";
  EXPECT_EQ(clean_text(euro + euro + euro, 7), euro + euro + "...");
  EXPECT_EQ(clean_text(euro + euro, 6), euro + euro);
}

TEST(ForeignText, FindsTheLastLineOfAnyFile) {
  const ScratchFolder folder;
  const auto last = [&](const std::string& content) {
    write_text(folder / "log", content);
    return last_line((folder / "log").string());
  };
  EXPECT_EQ(last(""), "");
  EXPECT_EQ(last("one\ntwo\n \n\n"), "two");
  EXPECT_EQ(last("10 %\r20 %\r"), "20 %");
  EXPECT_EQ(last("10 %\rall done\n"), "all done");
  EXPECT_EQ(last("first\n" + std::string(1U << 20U, 'x') + "\nlast \xe9"), "last ?");
  EXPECT_EQ(last(std::string(1U << 20U, 'x')).size(), 203U);
  EXPECT_EQ(last_line((folder / "none").string()), "");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(last_line((folder / "pipe").string()), "");
}

}  // namespace
}  // namespace odosplat::apps
