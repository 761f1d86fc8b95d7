// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/atomic_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "tests/io/temp_folder.hpp"

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

// Not even root can create files there.
TEST(AtomicFile, ReportsAFolderThatTakesNoFiles) {
  if (!std::filesystem::is_directory("/proc")) GTEST_SKIP() << "no /proc";
  EXPECT_THAT(error_of([] { write_file_atomically("/proc/odosplat/x", "x"); }),
              HasSubstr("/proc/odosplat/x: cannot be written"));
  EXPECT_THAT(error_of([] { ensure_output_folder("/proc").keep(); }), HasSubstr("/proc: cannot be written"));
}

unsigned mode_of(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
}

TEST(AtomicFile, KeepsTheModeOfWhatItReplaces) {
  const TempFolder temp;
  for (const mode_t mode : {0600U, 0640U, 0444U, 0777U}) {
    const std::string file = temp.put("f", "old");
    ASSERT_EQ(chmod(file.c_str(), mode), 0);
    write_file_atomically(file, "new");
    EXPECT_EQ(mode_of(file), mode);
    EXPECT_EQ(read_file(file), "new");
    std::filesystem::remove(file);
  }
}

TEST(AtomicFile, LeavesTheModeOfANewFileToTheUmask) {
  const TempFolder temp;
  for (const mode_t mask : {0022U, 0077U, 0002U}) {
    const mode_t old = umask(mask);
    const std::string file = temp / "f" + std::to_string(mask);
    write_file_atomically(file, "new");
    umask(old);
    EXPECT_EQ(mode_of(file), 0666U & ~mask);
  }
}

TEST(AtomicFile, IsAsPrivateInTheMakingAsWhatItReplaces) {
  const TempFolder temp;
  const std::string path = temp.put("f", "old");
  ASSERT_EQ(chmod(path.c_str(), 0600), 0);
  const AtomicFile file(path);
  EXPECT_EQ(mode_of(file.temporary_name()), 0600U);
}

TEST(AtomicFile, KeepsTheOwnerWhereItMay) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  const TempFolder temp;
  const std::string file = temp.put("f", "old");
  ASSERT_EQ(chown(file.c_str(), 65534, 65534), 0);
  write_file_atomically(file, "new");
  struct stat status {};
  ASSERT_EQ(stat(file.c_str(), &status), 0);
  EXPECT_EQ(status.st_uid, 65534U);
  EXPECT_EQ(status.st_gid, 65534U);
}

TEST(AtomicFile, WritesThroughALink) {
  const TempFolder temp;
  temp.put("disk/target", "old");
  std::filesystem::create_directories(temp / "links");
  std::filesystem::create_symlink("../disk/target", temp / "links/near");
  std::filesystem::create_symlink(temp / "links/near", temp / "far");
  write_file_atomically(temp / "far", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(temp / "far"));
  EXPECT_TRUE(std::filesystem::is_symlink(temp / "links/near"));
  EXPECT_EQ(read_file(temp / "disk/target"), "new");
  std::filesystem::remove(temp / "disk/target");
  write_file_atomically(temp / "far", "again");
  EXPECT_EQ(read_file(temp / "disk/target"), "again");
}

TEST(AtomicFile, RefusesTheLinkOfAStranger) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give links away";
  const TempFolder temp;
  temp.put("private", "private");
  std::filesystem::create_symlink(temp / "private", temp / "out");
  ASSERT_EQ(lchown((temp / "out").c_str(), 65534, 65534), 0);
  EXPECT_THAT(error_of([&] { write_file_atomically(temp / "out", "new"); }), HasSubstr("belongs to another user"));
  EXPECT_THAT(error_of([&] { ensure_output_file(temp / "out").keep(); }), HasSubstr("belongs to another user"));
  EXPECT_EQ(read_file(temp / "private"), "private");
}

TEST(AtomicFile, RefusesWhatIsNoRegularFile) {
  const TempFolder temp;
  ASSERT_EQ(mkfifo((temp / "pipe").c_str(), 0600), 0);
  for (const std::string& path : {temp / "pipe", std::string("/dev/null")}) {
    EXPECT_THAT(error_of([&] { write_file_atomically(path, "x"); }), HasSubstr("is not a regular file"));
    EXPECT_THAT(error_of([&] { ensure_output_file(path).keep(); }), HasSubstr("is not a regular file"));
  }
  EXPECT_TRUE(std::filesystem::is_fifo(temp / "pipe"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

TEST(AtomicFile, RefusesStandardOutput) {
  if (!std::filesystem::is_symlink("/dev/stdout")) GTEST_SKIP() << "no /dev/stdout";
  for (const std::string path : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    try {
      write_file_atomically(path, "text");
      FAIL() << path;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("outputs are files, not standard output")) << path;
    }
  }
  EXPECT_FALSE(std::filesystem::exists("-"));
}

TEST(AtomicFile, TemporaryNamesAreNotPredictable) {
  const TempFolder temp;
  const AtomicFile first(temp / "f");
  const AtomicFile second(temp / "f");
  EXPECT_THAT(first.temporary_name(), testing::MatchesRegex(".*/f\\.odosplat-[0-9a-f]{16}\\.part"));
  EXPECT_NE(first.temporary_name(), second.temporary_name());
}

TEST(AtomicFile, NoticesThatItsTemporaryWasReplaced) {
  const TempFolder temp;
  temp.put("private", "private");
  AtomicFile file(temp / "f");
  file.write("new");
  std::filesystem::remove(file.temporary_name());
  std::filesystem::create_symlink(temp / "private", file.temporary_name());
  EXPECT_THAT(error_of([&] { file.commit(); }), HasSubstr("replaced by another program"));
  EXPECT_EQ(read_file(temp / "private"), "private");
  EXPECT_FALSE(std::filesystem::exists(temp / "f"));
}

TEST(AtomicFile, TakesTheLongestNames) {
  const TempFolder temp;
  const std::string longest = temp / std::string(255, 'n');
  ensure_output_file(longest).keep();
  write_file_atomically(longest, "x");
  EXPECT_EQ(read_file(longest), "x");
}

class Leftovers : public testing::Test {
 protected:
  const std::string name_ = "map.ply.odosplat-0123456789abcdef.part";
  const TempFolder temp_;
};

TEST_F(Leftovers, OfAnOutputGoWhenItIsWrittenAgain) {
  temp_.put(name_, "half");
  temp_.put("map.ply.checkpoint.odosplat-0123456789abcdef.part", "half");
  temp_.put("clip.avi.odosplat-0123456789abcdef.part.avi", "half");
  temp_.put("other" + name_, "half");
  ensure_output_file(temp_ / "map.ply").keep();
  ensure_output_file(temp_ / "clip.avi").keep();
  EXPECT_THAT(temp_.files(), ElementsAre("other" + name_));
  ensure_output_folder(temp_.path()).keep();
  EXPECT_THAT(temp_.files(), IsEmpty());
}

TEST_F(Leftovers, StayWhileTheirProcessWorks) {
  AtomicFile file(temp_ / "map.ply");
  file.write("half");
  ensure_output_file(temp_ / "map.ply").keep();
  ensure_output_folder(temp_.path()).keep();
  file.write(" and half");
  file.commit();
  EXPECT_EQ(read_file(temp_ / "map.ply"), "half and half");
}

TEST_F(Leftovers, AreNothingElse) {
  const std::vector<std::string> names{
      "map.ply.part12_0", "map.ply.odosplat-0123456789abcdef", "map.ply.odosplat-0123456789abcdeF.part",
      "map.ply.odosplat-0123456789abcdef.part.txt", "map.ply.odosplat-0123456789abcde.part"};
  for (const std::string& name : names) temp_.put(name, "a file of the user");
  std::filesystem::create_directories(temp_ / name_);
  const std::string linked = "map.ply.odosplat-00000000000000ff.part";
  std::filesystem::create_symlink(temp_ / names[0], temp_ / linked);
  ensure_output_file(temp_ / "map.ply").keep();
  ensure_output_folder(temp_.path()).keep();
  EXPECT_EQ(temp_.files().size(), names.size() + 1);  // and the symbolic link to one of them
  EXPECT_TRUE(std::filesystem::is_directory(temp_ / name_));
  EXPECT_TRUE(std::filesystem::is_symlink(temp_ / linked));
}

TEST_F(Leftovers, OfAnotherUserStay) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  ASSERT_EQ(chown(temp_.put(name_, "half").c_str(), 65534, 65534), 0);
  ensure_output_file(temp_ / "map.ply").keep();
  EXPECT_THAT(temp_.files(), ElementsAre(name_));
}

TEST(OutputFolder, IsMadeAndProvedWritable) {
  const TempFolder temp;
  ensure_output_folder(temp / "a/b").keep();
  EXPECT_TRUE(std::filesystem::is_directory(temp / "a/b"));
  ensure_output_file(temp / "c/d.txt").keep();
  EXPECT_TRUE(std::filesystem::is_directory(temp / "c"));
  EXPECT_THAT(temp.files(), IsEmpty());
}

TEST(OutputFolder, GoesWithItsNewParentsWhenNothingWasWritten) {
  const TempFolder temp;
  std::filesystem::create_directories(temp / "old");
  {
    const MadeFolders folder = ensure_output_folder(temp / "old/a/b/");
    const MadeFolders file = ensure_output_file(temp / "c/d/e.txt");
    EXPECT_TRUE(std::filesystem::is_directory(temp / "old/a/b"));
    EXPECT_TRUE(std::filesystem::is_directory(temp / "c/d"));
  }
  EXPECT_TRUE(std::filesystem::is_directory(temp / "old"));
  EXPECT_FALSE(std::filesystem::exists(temp / "old/a"));
  EXPECT_FALSE(std::filesystem::exists(temp / "c"));
  {
    const MadeFolders folder = ensure_output_folder(temp / "old");
    const MadeFolders file = ensure_output_file(temp / "c/d/e.txt");
    write_file_atomically(temp / "c/d/e.txt", "text");
  }
  EXPECT_TRUE(std::filesystem::is_directory(temp / "old"));
  EXPECT_EQ(read_file(temp / "c/d/e.txt"), "text");
  { const AtomicFile never_committed(temp / "f/g.txt"); }
  EXPECT_FALSE(std::filesystem::exists(temp / "f"));
}

TEST(OutputFolder, RefusesAFileInItsPlace) {
  const TempFolder temp;
  const std::string file = temp.put("file", "");
  EXPECT_THAT(error_of([&] { ensure_output_folder(file).keep(); }), HasSubstr(file + ": cannot be written"));
  EXPECT_THAT(error_of([&] { ensure_output_folder(file + "/x").keep(); }), HasSubstr(file + "/x: cannot be written"));
  EXPECT_THAT(error_of([&] { ensure_output_file(file + "/x.png").keep(); }),
              HasSubstr(file + "/x.png: cannot be written"));
  EXPECT_THAT(error_of([&] { ensure_output_file(temp.path()).keep(); }), HasSubstr("is a folder"));
}

TEST(ReadFile, NamesWhatItCannotRead) {
  const TempFolder temp;
  EXPECT_EQ(error_of([&] { read_file(temp / "none"); }), temp / "none" + ": is missing");
  EXPECT_EQ(error_of([&] { read_file(temp.path()); }), temp.path() + ": is not a regular file but a folder");
  EXPECT_EQ(read_file(temp.put("empty", "")), "");
}

// Reading must neither wait for such a file nor continue until the memory is full.
TEST(ReadFile, ReadsRegularFilesOnly) {
  const TempFolder temp;
  const std::string fifo = temp / "fifo";
  ASSERT_EQ(mkfifo(fifo.c_str(), 0600), 0);
  for (const auto& [file, kind] : {std::pair<std::string, std::string>{fifo, "a pipe (FIFO)"},
                                   {"/dev/zero", "a device"},
                                   {temp.path(), "a folder"}}) {
    EXPECT_EQ(error_of([&, name = file] { read_file(name); }), file + ": is not a regular file but " + kind);
    EXPECT_EQ(error_of([&, name = file] { require_regular_file(name); }), file + ": is not a regular file but " + kind);
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
  std::filesystem::resize_file(file, max_text_bytes + 1);  // a sparse file: uses no space on the disk
  EXPECT_EQ(error_of([&] { read_file(file); }), file + ": is larger than the 256 MB that such a file may have");
  // A file whose size is given as 0 although it has content.
  EXPECT_THAT(error_of([] { read_file("/proc/self/maps", 100); }), HasSubstr("/proc/self/maps: is larger than"));
}

}  // namespace
}  // namespace odosplat
