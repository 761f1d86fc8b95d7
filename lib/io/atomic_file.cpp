// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/atomic_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;

// In the target's own folder: rename works within one file system only.
std::string name_beside(const std::string& path) { return path + ".part" + std::to_string(getpid()); }

[[noreturn]] void fail(const std::string& path, const std::string& beside, int error) {
  if (!beside.empty()) ::unlink(beside.c_str());
  throw InputError(path, std::string("cannot be written: ") + std::strerror(error));
}

void make_parent(const std::string& path) {
  const fs::path parent = fs::path(path).parent_path();
  if (parent.empty()) return;
  std::error_code error;
  fs::create_directories(parent, error);
  if (error) throw InputError(path, "cannot be written: " + parent.string() + ": " + error.message());
}

}  // namespace

void write_file_atomically(const std::string& path, const std::string& bytes) {
  make_parent(path);
  const std::string beside = name_beside(path);
  const int file = ::open(beside.c_str(), O_CREAT | O_WRONLY | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) fail(path, "", errno);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(file, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      ::close(file);
      fail(path, beside, error);
    }
    done += static_cast<std::size_t>(n);
  }
  if (::close(file) != 0) fail(path, beside, errno);
  if (std::rename(beside.c_str(), path.c_str()) != 0) fail(path, beside, errno);
}

void ensure_output_folder(const std::string& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw InputError(path, "cannot be written: " + error.message());
  if (!fs::is_directory(path, error)) throw InputError(path, "cannot be written: it is not a folder");
  const std::string probe = name_beside((fs::path(path) / "probe").string());
  const int file = ::open(probe.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0666);
  if (file < 0) fail(path, "", errno);
  ::close(file);
  ::unlink(probe.c_str());
}

void ensure_output_file(const std::string& path) {
  std::error_code error;
  if (fs::is_directory(path, error)) throw InputError(path, "cannot be written: it is a folder");
  const std::string parent = fs::path(path).parent_path().string();
  try {
    ensure_output_folder(parent.empty() ? "." : parent);
  } catch (const InputError& e) {
    throw InputError(path, std::string("cannot be written: ") + e.what());
  }
}

std::string read_file(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) throw InputError(path, std::strerror(errno));
  struct stat status {};
  if (::fstat(file, &status) != 0 || S_ISDIR(status.st_mode)) {
    ::close(file);
    throw InputError(path, "is not a file");
  }
  std::string content;
  content.reserve(static_cast<std::size_t>(status.st_size) + 1);
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
    content.append(block, static_cast<std::size_t>(n));
  }
  ::close(file);
  return content;
}

}  // namespace odosplat
