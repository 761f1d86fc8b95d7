// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Cached binaries are executed without further checks, so files that another user may have written must be ignored.
#include "odosplat/compute/program_cache.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>

namespace odosplat::compute {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Bytes = std::vector<unsigned char>;

class ProgramCacheTest : public testing::Test {
 protected:
  ProgramCacheTest() {
    std::string name = (fs::temp_directory_path() / "odosplat_cache_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder");
    scratch_ = name;
  }
  ~ProgramCacheTest() override { fs::remove_all(scratch_); }

  fs::path entry() const {
    fs::path found;
    for (const auto& e : fs::directory_iterator(folder())) found = e.path();
    return found;
  }
  std::string folder() const { return scratch_ / "a" / "kernels"; }
  static unsigned mode(const fs::path& path) {
    struct stat status {};
    return stat(path.c_str(), &status) == 0 ? status.st_mode & 0777U : 0;
  }

  fs::path scratch_;
  const std::string key_ = "platform\ndevice\nsource";
  const Bytes binary_{1, 2, 3, 4};
};

TEST_F(ProgramCacheTest, IsMadeForThisUserAlone) {
  const mode_t old = umask(0);
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  umask(old);
  EXPECT_EQ(cache.load(key_), binary_);
  EXPECT_EQ(mode(folder()), 0700U);
  EXPECT_EQ(mode(scratch_ / "a"), 0700U);
  EXPECT_EQ(mode(entry()), 0600U);
  EXPECT_EQ(cache.fault(), "");
}

TEST_F(ProgramCacheTest, AFolderThatOthersMayWriteToIsNotUsed) {
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  for (const mode_t open : {0770U, 0702U}) {
    ASSERT_EQ(chmod(folder().c_str(), open), 0);
    EXPECT_TRUE(cache.load(key_).empty());
    EXPECT_THAT(cache.fault(), HasSubstr(folder() + ": can be written by other users"));
    cache.store("another", binary_);
    EXPECT_EQ(std::distance(fs::directory_iterator(folder()), fs::directory_iterator()), 1);
  }
  ASSERT_EQ(chmod(folder().c_str(), 0755), 0);
  EXPECT_EQ(cache.load(key_), binary_);
}

TEST_F(ProgramCacheTest, AFileThatOthersMayWriteToIsNotRead) {
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  ASSERT_EQ(chmod(entry().c_str(), 0666), 0);
  EXPECT_TRUE(cache.load(key_).empty());
  cache.store(key_, binary_);
  EXPECT_EQ(cache.load(key_), binary_);
}

TEST_F(ProgramCacheTest, WhatAnotherUserOwnsIsNotUsed) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
  constexpr uid_t stranger = 65534;
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  ASSERT_EQ(chown(entry().c_str(), stranger, stranger), 0);
  EXPECT_TRUE(cache.load(key_).empty());
  ASSERT_EQ(chown(entry().c_str(), 0, 0), 0);
  EXPECT_EQ(cache.load(key_), binary_);
  ASSERT_EQ(chown(folder().c_str(), stranger, stranger), 0);
  EXPECT_TRUE(cache.load(key_).empty());
  EXPECT_THAT(cache.fault(), HasSubstr("belongs to another user"));
}

TEST_F(ProgramCacheTest, LinksAndPipesAreNotThere) {
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  const fs::path file = entry();
  fs::rename(file, scratch_ / "elsewhere");
  fs::create_symlink(scratch_ / "elsewhere", file);
  EXPECT_TRUE(cache.load(key_).empty());
  fs::remove(file);
  ASSERT_EQ(mkfifo(file.c_str(), 0600), 0);
  EXPECT_TRUE(cache.load(key_).empty());
  cache.store(key_, binary_);
  EXPECT_EQ(cache.load(key_), binary_);
}

TEST_F(ProgramCacheTest, ALinkInPlaceOfAnEntryIsReplacedAndNotFollowed) {
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  const fs::path file = entry();
  std::ofstream(scratch_ / "private") << "private";
  fs::remove(file);
  fs::create_symlink(scratch_ / "private", file);
  cache.store(key_, binary_);
  EXPECT_EQ(cache.load(key_), binary_);
  std::ifstream in(scratch_ / "private");
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "private");
}

// Two keys may map to the same file name: the binary is used only if the whole key is equal.
TEST_F(ProgramCacheTest, TheWholeKeyIsCompared) {
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  const fs::path file = entry();
  cache.store("device\n2", {9});
  for (const auto& e : fs::directory_iterator(folder())) {
    if (e.path() != file) fs::copy_file(e.path(), file, fs::copy_options::overwrite_existing);
  }
  EXPECT_TRUE(cache.load(key_).empty());
}

TEST_F(ProgramCacheTest, LeftoversOfKilledProcessesAreRemoved) {
  const ProgramCache cache(folder());
  cache.store(key_, binary_);
  const fs::path old = folder() + "/0123456789abcdef.bin.part-0123456789abcdef";
  const fs::path fresh = folder() + "/0123456789abcdef.bin.part-fedcba9876543210";
  std::ofstream(old) << "half";
  std::ofstream(fresh) << "half";
  fs::last_write_time(old, fs::file_time_type::clock::now() - std::chrono::hours(2));
  cache.store("another", binary_);
  EXPECT_FALSE(fs::exists(old));
  EXPECT_TRUE(fs::exists(fresh));
}

/// Sets or unsets an environment variable and restores it at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    value != nullptr ? setenv(name, value, 1) : unsetenv(name);
  }
  ~Variable() { old_ ? setenv(name_, old_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST_F(ProgramCacheTest, PoclsOwnCacheIsThisUsersToo) {
  const fs::path pocl = scratch_ / "pocl";
  const Variable direct("POCL_CACHE_DIR", nullptr);
  const Variable xdg("XDG_CACHE_HOME", scratch_.c_str());
  EXPECT_EQ(pocl_cache_fault(), "");
  fs::create_directories(pocl / "kcache");
  EXPECT_EQ(pocl_cache_fault(), "");
  for (const fs::path& part : {pocl, pocl / "kcache"}) {
    fs::permissions(part, fs::perms(0777));
    EXPECT_THAT(pocl_cache_fault(), HasSubstr("from " + part.string() + ", which everybody can write to"));
    fs::permissions(part, fs::perms(0755));
    if (geteuid() != 0) continue;
    ASSERT_EQ(chown(part.c_str(), 65534, 65534), 0);
    EXPECT_THAT(pocl_cache_fault(), HasSubstr("from " + part.string() + ", which belongs to another user"));
    ASSERT_EQ(chown(part.c_str(), 0, 0), 0);
  }
  const Variable named("POCL_CACHE_DIR", folder().c_str());
  EXPECT_EQ(pocl_cache_fault(), "");
  fs::create_directories(folder());
  fs::permissions(folder(), fs::perms(0777));
  EXPECT_THAT(pocl_cache_fault(), HasSubstr(folder()));
}

}  // namespace
}  // namespace odosplat::compute
