// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/apps/run_program.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "tests/locations.hpp"

namespace odosplat::apps_test {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "odosplat_test_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no scratch folder " + name);
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

namespace {

pid_t start(const std::string& program, const std::vector<std::string>& arguments, const std::string& out_file,
            const std::string& err_file) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    dup2(open(out_file.c_str(), O_CREAT | O_WRONLY, 0600), STDOUT_FILENO);
    dup2(open(err_file.c_str(), O_CREAT | O_WRONLY, 0600), STDERR_FILENO);
    execv(argv[0], argv.data());
    _exit(127);
  }
  return child;
}

/// Whether a process has a handler for the signal. Right after its start it has none, and SIGINT would end it.
bool handles(pid_t process, int signal) {
  std::istringstream status(read_text("/proc/" + std::to_string(process) + "/status"));
  for (std::string line; std::getline(status, line);) {
    if (line.rfind("SigCgt:", 0) != 0) continue;
    return ((std::stoull(line.substr(7), nullptr, 16) >> static_cast<unsigned>(signal - 1)) & 1U) != 0;
  }
  return false;
}

RunResult run_and_signal(const std::string& program, const std::vector<std::string>& arguments, int signal,
                         const std::function<bool()>& ready) {
  const ScratchFolder scratch;
  const std::string out_file = scratch / "out";
  const std::string err_file = scratch / "err";
  const pid_t child = start(program, arguments, out_file, err_file);
  int status = 0;
  while (signal != 0 && waitpid(child, &status, WNOHANG) == 0) {
    if ((signal != SIGINT || handles(child, signal)) && ready()) {
      kill(child, signal);
      signal = 0;
    } else {
      usleep(2000);
    }
  }
  if (signal == 0) waitpid(child, &status, 0);
  RunResult result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_text(out_file);
  result.err = read_text(err_file);
  return result;
}

}  // namespace

RunResult run_program(const std::string& program, const std::vector<std::string>& arguments) {
  return run_and_signal(program, arguments, 0, [] { return false; });
}

RunResult run_odosplat(const std::vector<std::string>& arguments) { return run_program(test::program(), arguments); }

RunResult run_odosplat_and_signal(const std::vector<std::string>& arguments, int signal,
                                  const std::function<bool()>& ready) {
  return run_and_signal(test::program(), arguments, signal, ready);
}

}  // namespace odosplat::apps_test
