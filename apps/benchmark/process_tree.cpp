// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/benchmark/process_tree.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>

#include "odosplat/core/formatted.hpp"

namespace odosplat::apps {
namespace {

struct Listed {
  pid_t pid;
  pid_t parent;
  double memory_mb;
};

/// Reads /proc/PID/stat. The process name, in parentheses, may contain any characters; after it follow state, parent,
/// ..., and as field 24 the number of resident pages. False if the process has ended.
bool read_entry(const char* pid, double page_mb, Listed& entry) {
  const int file = ::open(formatted("/proc/%s/stat", pid).c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  char text[1024];
  const ssize_t n = ::read(file, text, sizeof(text) - 1);
  ::close(file);
  if (n <= 0) return false;
  text[n] = '\0';
  const char* close = std::strrchr(text, ')');
  char state = 'Z';
  long parent = 0;
  long resident = 0;
  if (close == nullptr ||
      std::sscanf(close + 1, " %c %ld %*d %*d %*d %*d %*u %*u %*u %*u %*u %*u %*u %*d %*d %*d %*d %*d %*d %*u %*u %ld",
                  &state, &parent, &resident) != 3 ||
      state == 'Z' || state == 'X') {
    return false;
  }
  entry = {static_cast<pid_t>(std::atol(pid)), static_cast<pid_t>(parent), static_cast<double>(resident) * page_mb};
  return true;
}

std::vector<Listed> all_processes() {
  std::vector<Listed> all;
  DIR* folder = opendir("/proc");
  if (folder == nullptr) return all;
  const double page_mb = static_cast<double>(sysconf(_SC_PAGESIZE)) / 1048576.0;
  Listed entry{};
  while (const dirent* name = readdir(folder)) {
    if (std::isdigit(static_cast<unsigned char>(name->d_name[0])) != 0 && read_entry(name->d_name, page_mb, entry)) {
      all.push_back(entry);
    }
  }
  closedir(folder);
  return all;
}

}  // namespace

std::vector<ProcessEntry> descendants(pid_t root) {
  const std::vector<Listed> all = all_processes();
  std::vector<ProcessEntry> found{{root, 0.0}};
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (const Listed& process : all) {
      const bool known = std::any_of(found.begin(), found.end(), [&](const auto& f) { return f.pid == process.pid; });
      if (process.parent == found[k].pid && !known) found.push_back({process.pid, process.memory_mb});
    }
  }
  found.erase(found.begin());
  return found;
}

void signal_descendants(pid_t root, int signal) {
  for (const ProcessEntry& process : descendants(root)) ::kill(process.pid, signal);
}

void kill_descendants(pid_t root) {
  constexpr int most_rounds = 500;
  for (int i = 0; i < most_rounds; ++i) {
    const std::vector<ProcessEntry> left = descendants(root);
    if (left.empty()) return;
    // All are stopped before any is killed, so that none can fork while the list is processed.
    for (const ProcessEntry& process : left) ::kill(process.pid, SIGSTOP);
    for (const ProcessEntry& process : left) ::kill(process.pid, SIGKILL);
    const timespec pause{0, 10'000'000};
    ::nanosleep(&pause, nullptr);
  }
}

}  // namespace odosplat::apps
