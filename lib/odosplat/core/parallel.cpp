// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

std::atomic<int> thread_count{0};
thread_local bool inside_parallel_for = false;

}  // namespace

void set_threads(int n) {
  require(n >= 1, "threads", "at least 1");
  thread_count = n;
}

int threads() {
  const int n = thread_count;
  return n > 0 ? n : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void parallel_for(int n, int chunk, const std::function<void(int, int)>& body) {
  const int chunks = (n + chunk - 1) / chunk;
  const int workers = inside_parallel_for ? 1 : std::min(threads(), chunks);
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  auto work = [&] {
    for (int c = next++; c < chunks; c = next++) {
      try {
        body(c * chunk, std::min(n, (c + 1) * chunk));
      } catch (...) {
        const std::lock_guard lock(failure_mutex);
        if (!failure) failure = std::current_exception();
        next = chunks;
      }
    }
  };
  if (workers <= 1) {
    work();
  } else {
    std::vector<std::thread> pool;
    for (int i = 1; i < workers; ++i) {
      try {
        pool.emplace_back([&] {
          inside_parallel_for = true;
          work();
        });
      } catch (const std::system_error&) {
        break;  // the system gives no more threads: the existing ones do the work
      }
    }
    inside_parallel_for = true;
    work();
    inside_parallel_for = false;
    for (std::thread& t : pool) t.join();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace odosplat
