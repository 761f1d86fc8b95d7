// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/program_cache.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string_view>
#include <utility>

namespace odosplat::compute {
namespace {

constexpr char magic[8] = {'o', 's', 'p', 'l', 'a', 't', '0', '1'};
constexpr std::string_view part_mark = ".bin.part-";

// 64-bit FNV-1a as in core/checksum.hpp, repeated here because this library does not depend on core.
std::uint64_t hash(const void* data, std::size_t size) {
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::uint64_t h = 0xcbf29ce484222325ULL;
  for (std::size_t i = 0; i < size; ++i) h = (h ^ bytes[i]) * 0x100000001b3ULL;
  return h;
}

std::string hexadecimal(std::uint64_t value) {
  char text[20];
  std::snprintf(text, sizeof(text), "%016llx", static_cast<unsigned long long>(value));
  return text;
}

std::string entry_name(const std::string& key) { return hexadecimal(hash(key.data(), key.size())) + ".bin"; }

struct Header {
  char magic[8];
  std::uint64_t key_size;
  std::uint64_t binary_size;
  std::uint64_t binary_hash;
};

/// A file descriptor that is closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return value_; }
  bool is_open() const { return value_ >= 0; }

 private:
  int value_;
};

int open_folder(const std::string& folder) { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); }

/// Why binaries from this file or folder must not be run; empty if it belongs to this user and only they can write it.
std::string mistrust(const struct stat& status) {
  if (status.st_uid != geteuid()) return "belongs to another user";
  if ((status.st_mode & (S_IWGRP | S_IWOTH)) != 0) return "can be written by other users";
  return "";
}

bool is_trusted(const Descriptor& file) {
  struct stat status {};
  return file.is_open() && ::fstat(file.get(), &status) == 0 && mistrust(status).empty();
}

/// Creates all missing folders of the path, accessible to this user only.
void make_folders(const std::string& folder) {
  for (std::size_t at = folder.find('/', 1);; at = folder.find('/', at + 1)) {
    ::mkdir(folder.substr(0, at).c_str(), 0700);
    if (at == std::string::npos) return;
  }
}

std::string content_of(int file, std::size_t size) {
  std::string content(size, '\0');
  std::size_t got = 0;
  while (got < size) {
    const ssize_t n = ::read(file, content.data() + got, size - got);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    got += static_cast<std::size_t>(n);
  }
  content.resize(got);
  return content;
}

bool write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(file, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

/// Removes temporary files of processes that were killed while writing: writing takes milliseconds, so any temporary
/// file older than an hour is one.
void remove_leftovers(int folder) {
  constexpr std::time_t old = 3600;
  DIR* entries = fdopendir(::fcntl(folder, F_DUPFD_CLOEXEC, 0));
  if (entries == nullptr) return;
  const std::time_t now = std::time(nullptr);
  while (const dirent* entry = readdir(entries)) {
    struct stat status {};
    if (std::string_view(entry->d_name).find(part_mark) != std::string_view::npos &&
        ::fstatat(folder, entry->d_name, &status, AT_SYMLINK_NOFOLLOW) == 0 && now - status.st_mtime > old) {
      ::unlinkat(folder, entry->d_name, 0);
    }
  }
  closedir(entries);
}

}  // namespace

ProgramCache ProgramCache::from_environment() {
  if (const char* folder = std::getenv("ODOSPLAT_CACHE_DIR")) {
    return ProgramCache(std::strcmp(folder, "off") == 0 || *folder == '\0' ? "" : std::string(folder) + "/kernels");
  }
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder != nullptr && *folder != '\0') {
    return ProgramCache(std::string(folder) + "/odosplat/kernels");
  }
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0') {
    return ProgramCache(std::string(home) + "/.cache/odosplat/kernels");
  }
  return ProgramCache("");
}

std::string ProgramCache::fault() const {
  struct stat status {};
  if (folder_.empty() || ::stat(folder_.c_str(), &status) != 0) return "";
  const std::string why = S_ISDIR(status.st_mode) ? mistrust(status) : "is not a folder";
  if (why.empty()) return "";
  return folder_ + ": " + why + ": compiled kernels are neither read there nor kept (chmod 700, or set " +
         "ODOSPLAT_CACHE_DIR to a folder of your own)";
}

std::string pocl_cache_fault() {
  const auto set = [](const char* name) -> std::string {
    const char* value = std::getenv(name);
    return value == nullptr ? "" : value;
  };
  std::string folder = set("POCL_CACHE_DIR");
  std::string above;  // the parent folder, which PoCL creates too
  if (folder.empty()) {
    const std::string xdg = set("XDG_CACHE_HOME");
    const std::string home = set("HOME");
    above = !xdg.empty() ? xdg + "/pocl" : !home.empty() ? home + "/.cache/pocl" : "/tmp/pocl";
    folder = above + "/kcache";
  }
  for (const std::string& part : {above, folder}) {
    struct stat status {};
    if (part.empty() || ::stat(part.c_str(), &status) != 0) continue;
    const bool foreign = status.st_uid != geteuid();
    if (!foreign && (status.st_mode & S_IWOTH) == 0) continue;
    return "PoCL would run compiled kernels from " + part + ", which " +
           (foreign ? "belongs to another user" : "everybody can write to") +
           ": set POCL_CACHE_DIR to a folder of your own";
  }
  return "";
}

std::vector<unsigned char> ProgramCache::load(const std::string& key) const {
  if (folder_.empty()) return {};
  const Descriptor folder(open_folder(folder_));
  if (!is_trusted(folder)) return {};
  // O_NONBLOCK, because opening a named pipe would otherwise wait for its writer.
  const Descriptor file(
      ::openat(folder.get(), entry_name(key).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
  struct stat status {};
  if (!is_trusted(file) || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  constexpr std::size_t most_bytes = 1U << 28U;  // upper bound for the size of a compiled program
  const auto size = static_cast<std::size_t>(status.st_size);
  Header header{};
  if (size < sizeof(header) + key.size() || size > most_bytes) return {};
  const std::string content = content_of(file.get(), size);
  if (content.size() != size) return {};
  std::memcpy(&header, content.data(), sizeof(header));
  if (std::memcmp(header.magic, magic, sizeof(magic)) != 0 || header.key_size != key.size() ||
      size - sizeof(header) - key.size() != header.binary_size ||
      content.compare(sizeof(header), key.size(), key) != 0) {
    return {};
  }
  const char* binary = content.data() + sizeof(header) + key.size();
  if (hash(binary, header.binary_size) != header.binary_hash) return {};
  return {binary, binary + header.binary_size};
}

void ProgramCache::store(const std::string& key, const std::vector<unsigned char>& binary) const {
  if (folder_.empty() || binary.empty()) return;
  make_folders(folder_);
  const Descriptor folder(open_folder(folder_));
  if (!is_trusted(folder)) return;
  remove_leftovers(folder.get());
  std::uint64_t random = 0;
  if (getrandom(&random, sizeof(random), 0) != static_cast<ssize_t>(sizeof(random))) return;
  const std::string target = entry_name(key);
  const std::string beside = hexadecimal(hash(key.data(), key.size())) + std::string(part_mark) + hexadecimal(random);
  Header header{};
  std::memcpy(header.magic, magic, sizeof(magic));
  header.key_size = key.size();
  header.binary_size = binary.size();
  header.binary_hash = hash(binary.data(), binary.size());
  bool written = false;
  {
    const Descriptor file(
        ::openat(folder.get(), beside.c_str(), O_CREAT | O_EXCL | O_NOFOLLOW | O_WRONLY | O_CLOEXEC, 0600));
    if (!file.is_open()) return;
    written = write_all(file.get(), {reinterpret_cast<const char*>(&header), sizeof(header)}) &&
              write_all(file.get(), key) &&
              write_all(file.get(), {reinterpret_cast<const char*>(binary.data()), binary.size()});
  }
  if (!written || ::renameat(folder.get(), beside.c_str(), folder.get(), target.c_str()) != 0) {
    ::unlinkat(folder.get(), beside.c_str(), 0);
  }
}

}  // namespace odosplat::compute
