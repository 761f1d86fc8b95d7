// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/output.hpp"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat::apps {
namespace {

[[noreturn]] void fail_output() {
  const std::string reason = errno != 0 ? std::strerror(errno) : "an earlier line failed";
  throw InputError("standard output", "cannot be written: " + reason);
}

}  // namespace

MadeFolders ensure_output_if_given(const std::string& path) {
  return path.empty() ? MadeFolders({}) : ensure_output_file(path);
}

void check_extension(const std::string& path, std::initializer_list<const char*> extensions) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string names;
  for (const char* name : extensions) {
    if (extension == name) return;
    names += (names.empty() ? "" : " or ") + std::string(name);
  }
  throw InputError(path, "must end in " + names);
}

void print(const char* format, ...) {
  std::va_list arguments;
  va_start(arguments, format);
  const std::string shown = printable_text(formatted_list(format, arguments));
  va_end(arguments);
  errno = 0;
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size()) fail_output();
}

void finish_output() {
  errno = 0;
  std::cout.flush();
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) fail_output();
}

}  // namespace odosplat::apps
