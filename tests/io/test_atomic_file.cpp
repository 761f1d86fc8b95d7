// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(AtomicFile, MakesFoldersAndReplacesOldContent) {
  const TempFolder temp;
  write_file_atomically(temp / "a/b/c.txt", "old");
  write_file_atomically(temp / "a/b/c.txt", std::string("n\0w", 3));
  EXPECT_EQ(read_file(temp / "a/b/c.txt"), std::string("n\0w", 3));
  EXPECT_THAT(temp.files(), ElementsAre("a/b/c.txt"));
}

TEST(AtomicFile, ShowsTheOldContentUntilCommit) {
  const TempFolder temp;
  temp.put("f", "old");
  AtomicFile file(temp / "f");
  file.write("one ");
  file.write("two");
  EXPECT_EQ(read_file(temp / "f"), "old");
  file.commit();
  EXPECT_EQ(read_file(temp / "f"), "one two");
  EXPECT_THAT(temp.files(), ElementsAre("f"));
}

TEST(AtomicFile, LeavesNothingBehindWithoutCommit) {
  const TempFolder temp;
  {
    AtomicFile file(temp / "f");
    file.write("half of i");
  }
  EXPECT_THAT(temp.files(), IsEmpty());
}

TEST(AtomicFile, TwoWritersOfOnePathDoNotMix) {
  const TempFolder temp;
  AtomicFile first(temp / "f");
  AtomicFile second(temp / "f");
  first.write("first");
  second.write("second");
  first.commit();
  second.commit();
  EXPECT_EQ(read_file(temp / "f"), "second");
  EXPECT_THAT(temp.files(), ElementsAre("f"));
}

TEST(AtomicFile, NamesThePathThatCannotBeWritten) {
  const TempFolder temp;
  const std::string below_file = temp.put("file", "content") + "/below/x.txt";
  EXPECT_THAT(error_of([&] { write_file_atomically(below_file, "x"); }), HasSubstr(below_file + ": cannot be written"));
  std::filesystem::create_directories(temp / "folder");
  EXPECT_THAT(error_of([&] { write_file_atomically(temp / "folder", "x"); }),
              HasSubstr(temp / "folder: cannot be written"));
  EXPECT_THAT(temp.files(), ElementsAre("file"));
  EXPECT_EQ(read_file(temp / "file"), "content");
}

// Not even root may make files there.
TEST(AtomicFile, ReportsAFolderThatTakesNoFiles) {
  if (!std::filesystem::is_directory("/proc")) GTEST_SKIP() << "no /proc";
  EXPECT_THAT(error_of([] { write_file_atomically("/proc/odosplat/x", "x"); }),
              HasSubstr("/proc/odosplat/x: cannot be written"));
  EXPECT_THAT(error_of([] { ensure_output_folder("/proc"); }), HasSubstr("/proc: cannot be written"));
}

TEST(OutputFolder, IsMadeAndProvedWritable) {
  const TempFolder temp;
  ensure_output_folder(temp / "a/b");
  EXPECT_TRUE(std::filesystem::is_directory(temp / "a/b"));
  ensure_output_file(temp / "c/d.txt");
  EXPECT_TRUE(std::filesystem::is_directory(temp / "c"));
  EXPECT_THAT(temp.files(), IsEmpty());
}

TEST(OutputFolder, RefusesAFileInItsPlace) {
  const TempFolder temp;
  const std::string file = temp.put("file", "");
  EXPECT_THAT(error_of([&] { ensure_output_folder(file); }), HasSubstr(file + ": cannot be written"));
  EXPECT_THAT(error_of([&] { ensure_output_folder(file + "/x"); }), HasSubstr(file + "/x: cannot be written"));
  EXPECT_THAT(error_of([&] { ensure_output_file(file + "/x.png"); }), HasSubstr(file + "/x.png: cannot be written"));
  EXPECT_THAT(error_of([&] { ensure_output_file(temp.path()); }), HasSubstr("is a folder"));
}

TEST(ReadFile, NamesWhatItCannotRead) {
  const TempFolder temp;
  EXPECT_EQ(error_of([&] { read_file(temp / "none"); }), temp / "none" + ": is missing");
  EXPECT_EQ(error_of([&] { read_file(temp.path()); }), temp.path() + ": is not a file");
  EXPECT_EQ(read_file(temp.put("empty", "")), "");
}

}  // namespace
}  // namespace odosplat
