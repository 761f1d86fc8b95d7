// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/no_device.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace odosplat::compute {
namespace {

const char* variable(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : nullptr;
}

/// The folder of PoCL's kernel cache; PoCL reports no device if it cannot write there.
std::filesystem::path pocl_cache_folder() {
  if (const char* folder = variable("POCL_CACHE_DIR")) return folder;
  if (const char* folder = variable("XDG_CACHE_HOME")) return std::filesystem::path(folder) / "pocl/kcache";
  if (const char* home = variable("HOME")) return std::filesystem::path(home) / ".cache/pocl/kcache";
  return "/tmp/pocl/kcache";
}

/// The errno with which writing into a folder, or creating it, would fail; 0 if it can be written.
int write_error(std::filesystem::path folder) {
  std::error_code error;
  while (!std::filesystem::exists(folder, error) && folder.has_relative_path()) {
    if (error && error != std::errc::no_such_file_or_directory) return error.value();
    folder = folder.parent_path();
  }
  if (folder.empty()) folder = ".";
  if (!std::filesystem::is_directory(folder, error)) return ENOTDIR;
  return access(folder.c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

}  // namespace

std::string no_device_reason() {
  const std::filesystem::path cache = pocl_cache_folder();
  if (const int error = write_error(cache); error != 0) {
    return "PoCL cannot write its cache folder " + cache.string() + " (" + std::strerror(error) +
           "): set POCL_CACHE_DIR to a folder that can be written";
  }
  rlimit memory{};
  if (getrlimit(RLIMIT_AS, &memory) == 0 && memory.rlim_cur != RLIM_INFINITY) {
    return "memory is limited to " + std::to_string(memory.rlim_cur >> 20U) + " MiB (ulimit -v)";
  }
  return "install pocl-opencl-icd, which works on any CPU";
}

}  // namespace odosplat::compute
