// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <sys/types.h>

#include <vector>

namespace odosplat::apps {

/// A process listed in /proc.
struct ProcessEntry {
  pid_t pid = 0;
  double memory_mb = 0.0;  // resident
};

/// All descendants of a process, in whatever session or process group they are; not the process itself, and no zombies.
/// A process whose parent has ended is reparented to the nearest ancestor that is a child subreaper (prctl), so the
/// descendants of a subreaper are complete. Linux only.
std::vector<ProcessEntry> descendants(pid_t root);

/// Sends a signal to all descendants.
void signal_descendants(pid_t root, int signal);

/// Kills the descendants repeatedly until none is left, or for some seconds: a process blocked in the kernel cannot be
/// killed.
void kill_descendants(pid_t root);

}  // namespace odosplat::apps
