// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

// In the target's own folder, since rename works within one file system only; apart for each process and file.
std::string name_beside(const std::string& path) {
  static std::atomic<unsigned> count{0};
  return path + ".part" + std::to_string(getpid()) + "_" + std::to_string(count++);
}

// A FIFO would hang, a device would never end.
constexpr const char* not_regular = "is not a regular file";

std::string cannot_write(const std::string& reason) { return "cannot be written: " + reason; }

void make_folder(const std::string& folder, const std::string& named_in_error) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(named_in_error, cannot_write(error.message()));
}

void make_parent(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty()) make_folder(parent.string(), path);
}

void prove_writable(const std::string& folder, const std::string& named_in_error) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) throw InputError(named_in_error, cannot_write("not a folder"));
  const std::string probe = name_beside((fs::path(folder) / "probe").string());
  const int file = ::open(probe.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) throw InputError(named_in_error, cannot_write(std::strerror(errno)));
  ::close(file);
  ::unlink(probe.c_str());
}

}  // namespace

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)) {
  make_parent(path_);
  beside_ = name_beside(path_);
  file_ = ::open(beside_.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) throw InputError(path_, cannot_write(std::strerror(errno)));
}

AtomicFile::~AtomicFile() { discard(); }

void AtomicFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file_, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(errno);
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
}

void AtomicFile::commit() {
  const int closed = ::close(std::exchange(file_, -1));
  if (closed != 0) fail(errno);
  if (std::rename(beside_.c_str(), path_.c_str()) != 0) fail(errno);
  beside_.clear();
}

void AtomicFile::fail(int error) {
  discard();
  throw InputError(path_, cannot_write(std::strerror(error)));
}

void AtomicFile::discard() {
  if (file_ >= 0) ::close(std::exchange(file_, -1));
  if (!beside_.empty()) ::unlink(beside_.c_str());
  beside_.clear();
}

void write_file_atomically(const std::string& path, std::string_view bytes) {
  AtomicFile file(path);
  file.write(bytes);
  file.commit();
}

void ensure_output_folder(const std::string& path) {
  make_folder(path, path);
  prove_writable(path, path);
}

void ensure_output_file(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) throw InputError(path, cannot_write("is a folder"));
  make_parent(path);
  const std::string parent = fs::path(path).parent_path().string();
  prove_writable(parent.empty() ? "." : parent, path);
}

std::string read_file(const std::string& path, std::uint64_t max_bytes) {
  // O_NONBLOCK: opening a FIFO would wait for its writer. Regular files do not know the difference.
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) throw InputError(path, errno == ENOENT ? "is missing" : std::strerror(errno));
  struct stat status {};
  const bool known = ::fstat(file, &status) == 0;
  if (!known || !S_ISREG(status.st_mode)) {
    ::close(file);
    throw InputError(path, not_regular);
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
    // Files of /proc have a size of 0, and others grow.
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
  if (!S_ISREG(status.st_mode)) throw InputError(path, not_regular);
}

}  // namespace odosplat
