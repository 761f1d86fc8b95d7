// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/train/stages.hpp"

#include <chrono>

namespace odosplat::apps {

Stages::Stages(const std::string& what, int total) : progress_(what, total), ticker_([this] { tick(); }) {}

Stages::~Stages() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_one();
  ticker_.join();
}

void Stages::next(const std::string& name) {
  const std::lock_guard lock(mutex_);
  ++done_;
  name_ = name;
  stage_ = Stopwatch();
}

void Stages::tick() {
  constexpr double quiet_seconds = 2.0;
  constexpr auto period = std::chrono::milliseconds(500);
  const Stopwatch whole;
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, period, [this] { return ended_; })) {
    if (done_ < 0 || whole.seconds() < quiet_seconds) continue;
    progress_.update(done_, name_ + ", " + format_duration(stage_.seconds()));
  }
}

}  // namespace odosplat::apps
