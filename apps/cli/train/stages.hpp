// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "apps/command/support.hpp"
#include "odosplat/core/progress.hpp"

namespace odosplat::apps {

/// Progress of long work in a few stages whose own progress is unknown: after 2 s a progress line shows the stage and
/// its elapsed time, updated while it lasts.
class Stages {
 public:
  /// what: a word or two ("prepare"); total: the number of stages.
  Stages(const std::string& what, int total);
  ~Stages();
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  /// Begins the next stage ("smoothing the cloud").
  void next(const std::string& name);

 private:
  void tick();

  Progress progress_;  // used only by the ticker's thread
  std::mutex mutex_;
  std::condition_variable changed_;
  int done_ = -1;
  std::string name_;
  Stopwatch stage_;
  bool ended_ = false;
  std::thread ticker_;
};

}  // namespace odosplat::apps
