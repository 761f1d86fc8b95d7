// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace odosplat::apps_test {

/// Result of running a program: exit status (128 + n after signal n), standard output and standard error.
struct RunResult {
  int status = -1;
  std::string out;
  std::string err;
};

/// Runs a program with these arguments and waits. No shell is involved.
RunResult run_program(const std::string& program, const std::vector<std::string>& arguments);

/// The same with the odosplat program of this build.
RunResult run_odosplat(const std::vector<std::string>& arguments);

/// The same, but sends the signal when `ready` returns true, unless the program has ended before; SIGINT only
/// once the program handles it. `ready` is called
/// every few milliseconds.
RunResult run_odosplat_and_signal(const std::vector<std::string>& arguments, int signal,
                                  const std::function<bool()>& ready);

/// A temporary folder for a test, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string read_text(const std::filesystem::path& file);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace odosplat::apps_test
