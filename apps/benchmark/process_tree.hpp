// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <sys/types.h>

#include <vector>

namespace odosplat::apps {

/// A process as /proc has it.
struct ProcessEntry {
  pid_t pid = 0;
  double memory_mb = 0.0;  // resident
};

/// All children of a process, their children, and so on, whatever session or group they are in; not the process itself,
/// and not what has ended and is only waited for. Those whose parent ended belong to the nearest ancestor that is a
/// child subreaper (prctl), so below one nobody gets lost. Linux.
std::vector<ProcessEntry> descendants(pid_t root);

/// Sends a signal to all of them.
void signal_descendants(pid_t root, int signal);

/// Kills them until there is none, or for some seconds: what is stuck in the kernel cannot be killed.
void kill_descendants(pid_t root);

}  // namespace odosplat::apps
