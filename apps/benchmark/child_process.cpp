// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "child_process.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace odosplat::apps {
namespace {

constexpr int exit_not_found = 127;  // as a shell has it

/// Resident size of all processes of a group [MB].
double group_memory_mb(pid_t group) {
  double total = 0.0;
  DIR* folder = opendir("/proc");
  if (folder == nullptr) return 0.0;
  const double page_mb = static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
  while (const dirent* entry = readdir(folder)) {
    if (std::isdigit(static_cast<unsigned char>(entry->d_name[0])) == 0) continue;
    std::ifstream file(std::string("/proc/") + entry->d_name + "/stat");
    std::string line;
    if (!std::getline(file, line)) continue;
    // The name, in brackets, may hold anything; behind it: state, parent, group, ..., resident pages as 24th field.
    const auto close = line.rfind(')');
    if (close == std::string::npos) continue;
    long parent = 0;
    long own_group = 0;
    long resident = 0;
    const int found = std::sscanf(line.c_str() + close + 1,
                                  " %*c %ld %ld %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %*d %*d %*d %*d %*d %*d %*u "
                                  "%*u %ld",
                                  &parent, &own_group, &resident);
    if (found == 3 && own_group == group) total += static_cast<double>(resident) * page_mb;
  }
  closedir(folder);
  return total;
}

/// The last line with words in it, cut to a readable length.
std::string last_line(const std::string& file) {
  std::ifstream text(file);
  std::string line;
  std::string last;
  while (std::getline(text, line)) {
    // A progress bar overwrites its line.
    line = line.substr(line.rfind('\r') == std::string::npos ? 0 : line.rfind('\r') + 1);
    if (line.find_first_not_of(" \t") != std::string::npos) last = line;
  }
  constexpr std::size_t longest = 200;
  return last.size() > longest ? last.substr(0, longest) + "..." : last;
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log, const ProcessLimits& limits)
    : program_(command.at(0)), log_(log), limits_(limits), start_(std::chrono::steady_clock::now()) {
  std::vector<char*> arguments;
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error(std::string("no process can be made: ") + std::strerror(errno));
  if (pid_ == 0) {
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(exit_not_found);  // it died before the line above
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    const int nothing = open("/dev/null", O_RDONLY);
    const int file = open(log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (nothing < 0 || file < 0) _exit(exit_not_found);
    dup2(nothing, 0);
    dup2(file, 1);
    dup2(file, 2);
    execvp(arguments[0], arguments.data());
    _exit(exit_not_found);
  }
  setpgid(pid_, pid_);  // both do it: whoever comes first
}

ChildProcess::~ChildProcess() {
  if (pid_ < 0) return;
  signal_group(SIGKILL);
  waitpid(pid_, nullptr, 0);
}

double ChildProcess::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void ChildProcess::signal_group(int signal) const { kill(-pid_, signal); }

std::optional<ProcessEnd> ChildProcess::poll() {
  int status = 0;
  if (waitpid(pid_, &status, WNOHANG) == pid_) return ended(status);
  const double memory = group_memory_mb(pid_);
  peak_memory_mb_ = std::max(peak_memory_mb_, memory);
  // Words without measured values: tables of two runs are to be equal.
  if (memory > limits_.memory_mb) {
    verdict_ = "stopped at the memory limit of " + std::to_string(std::lround(limits_.memory_mb)) + " MB";
  } else if (seconds() > limits_.seconds) {
    verdict_ = "stopped at the time limit of " + std::to_string(std::lround(limits_.seconds)) + " s";
  } else {
    return std::nullopt;
  }
  signal_group(SIGKILL);
  waitpid(pid_, &status, 0);
  return ended(status);
}

void ChildProcess::stop(double patience) {
  signal_group(SIGTERM);
  const double until = seconds() + patience;
  int status = 0;
  while (seconds() < until) {
    if (waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  signal_group(SIGKILL);
  waitpid(pid_, &status, 0);
  pid_ = -1;
}

ProcessEnd ChildProcess::ended(int status) {
  signal_group(SIGKILL);  // what it left running
  pid_ = -1;
  ProcessEnd end;
  end.seconds = seconds();
  end.peak_memory_mb = peak_memory_mb_;
  if (!verdict_.empty()) {
    end.fault = verdict_;
  } else if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    end.fault = "killed by signal " + std::to_string(signal) + " (" + strsignal(signal) + ")";
  } else if (WEXITSTATUS(status) != 0) {
    const std::string words = last_line(log_);
    end.fault = "exit " + std::to_string(WEXITSTATUS(status));
    if (!words.empty()) end.fault += ": " + words;
    if (WEXITSTATUS(status) == exit_not_found && words.empty()) end.fault = program_ + " cannot be run";
  }
  return end;
}

}  // namespace odosplat::apps
