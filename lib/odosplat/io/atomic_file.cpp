// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

// The name of a file type that is not read: reading a FIFO could block, and a device may never end.
std::string not_regular(mode_t mode) {
  const char* kind = S_ISDIR(mode)                    ? "a folder"
                     : S_ISFIFO(mode)                 ? "a pipe (FIFO)"
                     : S_ISSOCK(mode)                 ? "a socket"
                     : S_ISCHR(mode) || S_ISBLK(mode) ? "a device"
                                                      : "something else";
  return std::string("is not a regular file but ") + kind;
}

std::string cannot_write(const std::string& reason) { return "cannot be written: " + reason; }

std::string reason_of(const std::system_error& e) {
  return e.code().value() == ESTALE ? "its temporary file was replaced by another program" : e.code().message();
}

/// Creates the folder and its parents; returns those that were missing.
MadeFolders make_folder(const std::string& folder, const std::string& named_in_error) {
  std::error_code error;
  std::vector<std::string> missing;
  for (fs::path at(folder); !at.empty() && !fs::exists(at, error); at = at.parent_path()) {
    missing.push_back(at.string());
    if (at == at.parent_path()) break;
  }
  fs::create_directories(folder, error);
  if (error) {
    const MadeFolders some(std::move(missing));  // removes parents that were created before the failure
    throw InputError(named_in_error, cannot_write(error.message()));
  }
  return MadeFolders(std::move(missing));
}

std::string parent_of(const std::string& path) {
  const std::string parent = fs::path(path).parent_path().string();
  return parent.empty() ? "." : parent;
}

constexpr const char* no_stream = "cannot be written: outputs are files, not standard output or another open file";

/// The file that writing to the path replaces. Links at its end are resolved here, because rename() would replace the
/// link itself. Links of other users (except root) are refused, because they could redirect the output.
std::string resolved(const std::string& path) {
  constexpr int most_links = 40;
  if (path == "-") throw InputError(path, no_stream);
  fs::path at(path);
  for (int i = 0; i < most_links; ++i) {
    // The link of an open file names what is behind it, which would be replaced under those who have it open.
    const std::string folder = at.lexically_normal().parent_path().string();
    const bool of_open_files = folder == "/dev/fd" || (folder.starts_with("/proc/") && folder.ends_with("/fd"));
    if (of_open_files) throw InputError(path, no_stream);
    struct stat status {};
    if (::lstat(at.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) return at.string();
    if (status.st_uid != geteuid() && status.st_uid != 0) {
      throw InputError(path, cannot_write("it is a link that belongs to another user"));
    }
    std::error_code error;
    const fs::path next = fs::read_symlink(at, error);
    if (error) throw InputError(path, cannot_write(error.message()));
    at = at.parent_path() / next;  // operator/ leaves an absolute `next` as it is
  }
  throw InputError(path, cannot_write("too many links"));
}

/// True if the target exists and is a regular file, false if it does not exist; InputError if it is anything else.
bool find_replaced(const std::string& path, const std::string& target, struct stat& status) {
  if (::lstat(target.c_str(), &status) != 0) return false;
  if (S_ISDIR(status.st_mode)) throw InputError(path, cannot_write("is a folder"));
  if (!S_ISREG(status.st_mode)) throw InputError(path, cannot_write(not_regular(status.st_mode)));
  return true;
}

void prove_writable(const std::string& folder, const std::string& named_in_error) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw InputError(named_in_error, cannot_write("not a folder"));
  try {
    const TemporaryFile probe((fs::path(folder) / "probe").string(), 0600);
  } catch (const std::system_error& e) {
    throw InputError(named_in_error, cannot_write(reason_of(e)));
  }
}

}  // namespace

MadeFolders::~MadeFolders() {
  // remove() deletes a folder only if it is empty.
  for (const std::string& folder : folders_) {
    std::error_code ignored;
    if (fs::is_directory(folder, ignored)) fs::remove(folder, ignored);
  }
}

AtomicFile::AtomicFile(std::string path, TemporaryName name)
    : path_(std::move(path)), target_(resolved(path_)), made_(make_folder(parent_of(target_), path_)) {
  struct stat old {};
  if (find_replaced(path_, target_, old)) {
    old_mode_ = static_cast<int>(old.st_mode & 0777U);
    old_owner_ = old.st_uid;
    old_group_ = old.st_gid;
  }
  try {
    // If it replaces a file, the temporary file is private until it gets that file's mode, which may be private.
    std::string extension = name == TemporaryName::plain ? "" : fs::path(path_).extension().string();
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    temporary_ = std::make_unique<TemporaryFile>(target_, old_mode_ < 0 ? 0666 : 0600, extension);
  } catch (const std::system_error& e) {
    throw InputError(path_, cannot_write(reason_of(e)));
  }
}

AtomicFile::~AtomicFile() = default;

const std::string& AtomicFile::temporary_name() const { return temporary_->name(); }

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(temporary_->descriptor(), bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void AtomicFile::commit(Durability durability) {
  if (old_mode_ >= 0) {
    auto mode = static_cast<mode_t>(old_mode_);
    const int file = temporary_->descriptor();
    struct stat made {};
    if (::fstat(file, &made) != 0) fail(std::strerror(errno));
    const bool same_group = made.st_gid == old_group_ || ::fchown(file, static_cast<uid_t>(-1), old_group_) == 0;
    // If the group cannot be kept, the new group gets only the permissions of others.
    if (!same_group) mode = (mode & ~070U) | ((mode & 07U) << 3U);
    // Only root may change the owner of a file; for other users the new file belongs to them.
    if (made.st_uid != old_owner_ && ::fchown(file, old_owner_, static_cast<gid_t>(-1)) != 0 && errno != EPERM) {
      fail(std::strerror(errno));
    }
    if (::fchmod(file, mode) != 0) fail(std::strerror(errno));
  }
  try {
    temporary_->rename_to(target_, durability == Durability::synced);
  } catch (const std::system_error& e) {
    fail(reason_of(e));
  }
  temporary_.reset();
}

void AtomicFile::fail(const std::string& reason) {
  temporary_.reset();
  throw InputError(path_, cannot_write(reason));
}

void write_file_atomically(const std::string& path, std::string_view bytes, Durability durability) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit(durability);
}

MadeFolders ensure_output_folder(const std::string& path) {
  MadeFolders made = make_folder(path, path);
  prove_writable(path, path);
  remove_leftovers(path, "");
  return made;
}

MadeFolders ensure_output_file(const std::string& path) {
  const std::string target = resolved(path);
  struct stat ignored {};
  find_replaced(path, target, ignored);
  const std::string parent = parent_of(target);
  MadeFolders made = make_folder(parent, path);
  prove_writable(parent, path);
  remove_leftovers(parent, fs::path(target).filename().string());
  return made;
}

std::string read_file(const std::string& path, std::uint64_t max_bytes) {
  // O_NONBLOCK, because opening a FIFO would otherwise wait for its writer. It has no effect on regular files.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw InputError(path, errno == ENOENT ? "is missing" : std::strerror(errno));
  struct stat status {};
  const bool known = ::fstat(file, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    ::close(file);
    throw InputError(path, known ? not_regular(status.st_mode) : "cannot be read");
  }
  const auto refuse_above = [&](std::uint64_t bytes) {
    if (bytes <= max_bytes) return;
    ::close(file);
    throw InputError(path, "is larger than the " + std::to_string(max_bytes >> 20U) + " MB that such a file may have");
  };
  refuse_above(static_cast<std::uint64_t>(status.st_size));
  std::string content;
  content.reserve(static_cast<std::size_t>(status.st_size));
  char block[1 << 16];
  while (true) {
    const ssize_t n = ::read(file, block, sizeof(block));
    if (n == 0) break;
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      ::close(file);
      throw InputError(path, std::string("cannot be read: ") + std::strerror(error));
    }
    // Checked again while reading: files of /proc have size 0, and a file may grow.
    refuse_above(content.size() + static_cast<std::uint64_t>(n));
    content.append(block, static_cast<std::size_t>(n));
  }
  ::close(file);
  return content;
}

void require_regular_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    throw InputError(path, errno == ENOENT ? "is missing" : std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode)) throw InputError(path, not_regular(status.st_mode));
}

}  // namespace odosplat
