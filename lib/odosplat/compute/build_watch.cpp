// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/compute/build_watch.hpp"

#include <algorithm>
#include <utility>

#include "odosplat/compute/build_notice.hpp"

namespace odosplat::compute {

void set_build_notice(const Context& context, std::function<void()> notice, double after_s) {
  context.shared_impl()->build_notice = std::move(notice);
  context.shared_impl()->build_notice_after_s = after_s;
}

BuildWatch::BuildWatch(ContextImpl& context) : context_(context) {
  if (context_.build_notice) waiter_ = std::thread([this] { wait(); });
}

BuildWatch::~BuildWatch() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_all();
  context_.build_s += seconds();
  if (!waiter_.joinable()) return;
  waiter_.join();
  if (given_) context_.build_notice = nullptr;
}

void BuildWatch::wait() {
  const std::chrono::duration<double> rest(std::max(0.0, context_.build_notice_after_s - context_.build_s));
  std::unique_lock lock(mutex_);
  // The build may have ended before this thread started waiting, so the elapsed time decides.
  if (ended_.wait_for(lock, rest, [this] { return done_; }) && seconds() < rest.count()) return;
  given_ = true;
  context_.build_notice();
}

}  // namespace odosplat::compute
