// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

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
  EXPECT_EQ(error_of([&] { read_file(temp.path()); }), temp.path() + ": is not a regular file");
  EXPECT_EQ(read_file(temp.put("empty", "")), "");
}

// None of them is waited for, and none is read until the memory is full.
TEST(ReadFile, ReadsRegularFilesOnly) {
  const TempFolder temp;
  const std::string fifo = temp / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const std::string& file : {fifo, std::string("/dev/zero"), temp.path()}) {
    EXPECT_EQ(error_of([&] { read_file(file); }), file + ": is not a regular file");
    EXPECT_EQ(error_of([&] { require_regular_file(file); }), file + ": is not a regular file");
  }
  EXPECT_EQ(error_of([&] { require_regular_file(temp / "none"); }), temp / "none" + ": is missing");
  const std::string file = temp.put("file", "text");
  require_regular_file(file);
  std::filesystem::create_symlink(file, temp / "link");
  require_regular_file(temp / "link");
  EXPECT_EQ(read_file(temp / "link"), "text");
}

TEST(ReadFile, HoldsNoMoreThanItsLimit) {
  const TempFolder temp;
  const std::string file = temp.put("file", "12345");
  EXPECT_EQ(read_file(file, 5), "12345");
  EXPECT_THAT(error_of([&] { read_file(file, 4); }), HasSubstr(file + ": is larger than"));
  std::filesystem::resize_file(file, max_text_bytes + 1);  // a hole: no space on the disk
  EXPECT_EQ(error_of([&] { read_file(file); }), file + ": is larger than the 256 MB that such a file may have");
  // Says that it has no bytes, and has some.
  EXPECT_THAT(error_of([] { read_file("/proc/self/maps", 100); }), HasSubstr("/proc/self/maps: is larger than"));
}

}  // namespace
}  // namespace odosplat
