// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/child_process.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "apps/benchmark/foreign_text.hpp"
#include "apps/benchmark/process_tree.hpp"

namespace odosplat::apps {
namespace {

constexpr int exit_not_found = 127;  // the status of a shell for a command that it cannot run

// The program runs below a supervising process, which adopts all orphaned descendants (PR_SET_CHILD_SUBREAPER). It
// therefore finds them in whatever session they are, and kills all of them when the program or the runner ends. The
// functions below run in the supervisor. It does not call exec(): after fork() the C library allows allocation, and
// nothing else is needed that another thread of the runner may have locked.

/// Connects standard output and error to the log, standard input to /dev/null, and closes all other descriptors
/// inherited from the runner.
bool connect(const char* log) {
  const int nothing = open("/dev/null", O_RDONLY);
  ::unlink(log);
  const int file = open(log, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW, 0666);
  if (nothing < 0 || file < 0) return false;
  dup2(nothing, 0);
  dup2(file, 1);
  dup2(file, 2);
  return close_range(3, ~0U, 0) == 0;
}

/// Ends this process with the program's exit status or by its signal, so that the runner sees how the program ended.
[[noreturn]] void end_like(int status) {
  if (WIFSIGNALED(status)) {
    const int signal = WTERMSIG(status);
    std::signal(signal, SIG_DFL);
    sigset_t all;
    sigemptyset(&all);
    sigprocmask(SIG_SETMASK, &all, nullptr);
    raise(signal);
  }
  _exit(WIFEXITED(status) ? WEXITSTATUS(status) : exit_not_found);
}

[[noreturn]] void supervise(pid_t runner, const char* log, char* const* command) {
  setpgid(0, 0);  // a process group of its own: the terminal's Ctrl-C reaches the runner only
  sigset_t events;
  sigset_t before;
  sigfillset(&events);
  sigprocmask(SIG_SETMASK, &events, &before);
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != runner) _exit(exit_not_found);  // the runner died before prctl() took effect
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (!connect(log)) _exit(exit_not_found);
  const pid_t self = getpid();
  const pid_t program = fork();
  if (program == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != self) _exit(exit_not_found);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      if (std::signal(signal, SIG_IGN) != SIG_IGN) std::signal(signal, SIG_DFL);
    }
    sigprocmask(SIG_SETMASK, &before, nullptr);
    execvp(command[0], command);
    _exit(exit_not_found);
  }
  int status = exit_not_found << 8;
  bool ended = program < 0;
  sigemptyset(&events);
  sigaddset(&events, SIGCHLD);
  sigaddset(&events, SIGTERM);
  while (!ended) {
    if (sigwaitinfo(&events, nullptr) == SIGTERM) {  // sent by the kernel when the runner dies, or by the runner itself
      status = SIGTERM;
      break;
    }
    int some_status = 0;
    for (pid_t child = waitpid(-1, &some_status, WNOHANG); child > 0; child = waitpid(-1, &some_status, WNOHANG)) {
      if (child != program) continue;
      status = some_status;
      ended = true;
    }
  }
  kill_descendants(self);
  while (waitpid(-1, nullptr, WNOHANG) > 0) {
  }
  end_like(status);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command, const std::string& log, const ProcessLimits& limits)
    : program_(command.at(0)), log_(log), limits_(limits), start_(std::chrono::steady_clock::now()) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t runner = getpid();
  supervisor_ = fork();
  if (supervisor_ < 0) throw std::runtime_error(std::string("no process can be made: ") + std::strerror(errno));
  if (supervisor_ == 0) supervise(runner, log_.c_str(), arguments.data());
}

ChildProcess::~ChildProcess() {
  if (supervisor_ >= 0) kill_all();
}

double ChildProcess::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

int ChildProcess::kill_all() {
  ::kill(supervisor_, SIGTERM);
  int status = 0;
  waitpid(supervisor_, &status, 0);
  supervisor_ = -1;
  return status;
}

std::optional<ProcessEnd> ChildProcess::poll() {
  int status = 0;
  if (waitpid(supervisor_, &status, WNOHANG) == supervisor_) return ended(status);
  double memory = 0.0;
  for (const ProcessEntry& process : descendants(supervisor_)) memory += process.memory_mb;
  peak_memory_mb_ = std::max(peak_memory_mb_, memory);
  // The texts contain no measured values, so that the tables of two runs are equal.
  if (memory > limits_.memory_mb) {
    verdict_ = "stopped at the memory limit of " + std::to_string(std::lround(limits_.memory_mb)) + " MB";
  } else if (seconds() > limits_.seconds) {
    verdict_ = "stopped at the time limit of " + std::to_string(std::lround(limits_.seconds)) + " s";
  } else {
    return std::nullopt;
  }
  return ended(kill_all());
}

void ChildProcess::stop(double patience) {
  signal_descendants(supervisor_, SIGTERM);
  const double until = seconds() + patience;
  int status = 0;
  while (seconds() < until) {
    if (waitpid(supervisor_, &status, WNOHANG) == supervisor_) {
      supervisor_ = -1;
      return;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  kill_all();
}

ProcessEnd ChildProcess::ended(int status) {
  supervisor_ = -1;
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
