// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace odosplat::apps {

/// Makes Ctrl-C, SIGTERM and the end of the terminal (SIGHUP, unless it is ignored as under nohup) set a flag, which
/// long loops check. A process that has not ended after 0.5 s is ended with status 130, unless a SavesWhenInterrupted
/// exists; this is safe because outputs are written completely or not at all. A second Ctrl-C or SIGTERM ends the
/// process at once.
void catch_interrupts();
bool interrupted();

/// While an object exists, the process is not ended 0.5 s after an interrupt: the command checks interrupted() often
/// and then saves its results.
class SavesWhenInterrupted {
 public:
  SavesWhenInterrupted();
  ~SavesWhenInterrupted();
  SavesWhenInterrupted(const SavesWhenInterrupted&) = delete;
  SavesWhenInterrupted& operator=(const SavesWhenInterrupted&) = delete;
};

}  // namespace odosplat::apps
