// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

namespace odosplat::apps {

/// Ctrl-C, SIGTERM and the end of the terminal (SIGHUP, unless it is ignored as under nohup) set a flag; long loops ask
/// it. Outputs appear whole or not at all, so whatever has not ended 0.5 s later is ended here, with status 130, unless
/// a SavesWhenInterrupted lives. A second Ctrl-C or SIGTERM ends the process at once.
void catch_interrupts();
bool interrupted();

/// Lives while a command asks interrupted() often and then writes what it has so far.
class SavesWhenInterrupted {
 public:
  SavesWhenInterrupted();
  ~SavesWhenInterrupted();
  SavesWhenInterrupted(const SavesWhenInterrupted&) = delete;
  SavesWhenInterrupted& operator=(const SavesWhenInterrupted&) = delete;
};

}  // namespace odosplat::apps
