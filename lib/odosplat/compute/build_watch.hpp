// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "odosplat/compute/opencl.hpp"

namespace odosplat::compute {

/// Exists while a program is built: adds the time to the context's total and calls its build notice when it is due.
/// Private to this folder.
class BuildWatch {
 public:
  explicit BuildWatch(ContextImpl& context);
  ~BuildWatch();
  BuildWatch(const BuildWatch&) = delete;
  BuildWatch& operator=(const BuildWatch&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  void wait();
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  ContextImpl& context_;
  Clock::time_point start_ = Clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  bool done_ = false;
  bool given_ = false;
  std::thread waiter_;
};

}  // namespace odosplat::compute
