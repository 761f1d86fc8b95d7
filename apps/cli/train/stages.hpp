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

/// Long work that runs in a few stages and cannot say how far it is: after 2 s a progress line names the stage and how
/// long it has been at it, redrawn while it lasts.
class Stages {
 public:
  /// what: a word or two ("prepare"); total: the number of stages.
  Stages(const std::string& what, int total);
  ~Stages();
  Stages(const Stages&) = delete;
  Stages& operator=(const Stages&) = delete;

  /// The next one begins ("smoothing the cloud").
  void next(const std::string& name);

 private:
  void tick();

  Progress progress_;  // of the ticker alone
  std::mutex mutex_;
  std::condition_variable changed_;
  int done_ = -1;
  std::string name_;
  Stopwatch stage_;
  bool ended_ = false;
  std::thread ticker_;
};

}  // namespace odosplat::apps
