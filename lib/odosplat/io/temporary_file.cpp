// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/temporary_file.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view mark = ".odosplat-";
constexpr std::string_view part_ending = ".part";
constexpr std::size_t digits = 16;

[[noreturn]] void fail() { throw std::system_error(errno, std::generic_category()); }

std::string random_digits() {
  std::uint64_t value = 0;
  if (getrandom(&value, sizeof(value), 0) != static_cast<ssize_t>(sizeof(value))) fail();
  return formatted("%016llx", static_cast<unsigned long long>(value));
}

// Shortens names so that the temporary name does not exceed NAME_MAX; their start is enough to recognise them.
std::string stem_of(const std::string& name) {
  constexpr std::size_t longest_extension = 8;
  constexpr std::size_t added = mark.size() + digits + part_ending.size() + longest_extension;
  return name.substr(0, std::min<std::size_t>(name.size(), NAME_MAX - added));
}

bool is_temporary_name(std::string_view entry, const std::string& stem) {
  const std::size_t at = entry.rfind(mark);
  if (at == std::string_view::npos) return false;
  const std::string_view output = entry.substr(0, at);
  if (!stem.empty() && output != stem && !output.starts_with(stem + ".")) return false;
  std::string_view rest = entry.substr(at + mark.size());
  if (rest.size() < digits + part_ending.size()) return false;
  const bool random = std::all_of(rest.begin(), rest.begin() + digits,
                                  [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
  rest.remove_prefix(digits);
  if (!random || !rest.starts_with(part_ending)) return false;
  rest.remove_prefix(part_ending.size());
  return rest.empty() || rest == ".mp4" || rest == ".avi";
}

bool locks_reach_all(int folder) {
  struct statfs status {};
  if (fstatfs(folder, &status) != 0) return false;
  constexpr std::uint32_t network[] = {
      0x6969,     0xff534d42, 0xfe534d42, 0x517b,    0x01021997,
      0x65735546, 0x00c36400, 0x0bd00bd0, 0x47504653};  // NFS, CIFS, SMB2, SMB, 9P, FUSE, Ceph, Lustre, GPFS
  const auto type = static_cast<std::uint32_t>(status.f_type);
  return std::find(std::begin(network), std::end(network), type) == std::end(network);
}

bool is_regular_of_this_user(const struct stat& status) {
  return S_ISREG(status.st_mode) && status.st_uid == geteuid() && status.st_nlink == 1;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::string& path, mode_t mode, const std::string& extension) {
  const fs::path whole(path);
  const std::string start = (whole.parent_path() / stem_of(whole.filename().string())).string() + std::string(mark);
  const std::string end = std::string(part_ending) + extension;
  while (true) {
    name_ = start;
    name_ += random_digits();
    name_ += end;
    file_ = ::open(name_.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, mode);
    if (file_ < 0 && (errno == EEXIST || errno == EINTR)) continue;
    if (file_ < 0) fail();
    const bool locked = ::flock(file_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
    struct stat status {};
    // Between open() and flock() another process may have removed the file as a leftover: then try again.
    if (locked && ::fstat(file_, &status) == 0 && status.st_nlink > 0) return;
    ::close(std::exchange(file_, -1));
  }
}

TemporaryFile::~TemporaryFile() {
  if (!name_.empty()) ::unlink(name_.c_str());
  if (file_ >= 0) ::close(file_);
}

void TemporaryFile::rename_to(const std::string& path, bool synced) {
  struct stat mine {};
  struct stat there {};
  if (::fstat(file_, &mine) != 0 || ::lstat(name_.c_str(), &there) != 0) fail();
  if (mine.st_ino != there.st_ino || mine.st_dev != there.st_dev) {
    throw std::system_error(ESTALE, std::generic_category(), "its temporary file was replaced");
  }
  // Some file systems do not support fsync().
  if (synced && ::fsync(file_) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) fail();
  if (std::rename(name_.c_str(), path.c_str()) != 0) fail();
  name_.clear();
  if (::close(std::exchange(file_, -1)) != 0) fail();
  if (!synced) return;
  const std::string parent = fs::path(path).parent_path().string();
  const int folder = ::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  ::fsync(folder);
  ::close(folder);
}

void remove_leftovers(const std::string& folder, const std::string& name) {
  DIR* entries = opendir(folder.empty() ? "." : folder.c_str());
  if (entries == nullptr) return;
  const int at = dirfd(entries);
  const std::string stem = stem_of(name);
  if (locks_reach_all(at)) {
    while (const dirent* entry = readdir(entries)) {
      if (!is_temporary_name(entry->d_name, stem)) continue;
      const int file = ::openat(at, entry->d_name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
      if (file < 0) continue;
      struct stat status {};
      if (::fstat(file, &status) == 0 && is_regular_of_this_user(status) && ::flock(file, LOCK_EX | LOCK_NB) == 0) {
        ::unlinkat(at, entry->d_name, 0);
      }
      ::close(file);
    }
  }
  closedir(entries);
}

}  // namespace odosplat
