// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/command/interrupt.hpp"

#include <semaphore.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "apps/command/exit_status.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::apps {
namespace {

std::atomic<bool> interrupt_flag{false};
std::atomic<int> savers{0};
sem_t interrupt_came;

extern "C" void on_interrupt(int signal) {
  if (!interrupt_flag.exchange(true)) {
    sem_post(&interrupt_came);
  } else if (signal != SIGHUP) {  // SIGHUP may come several times when a terminal closes
    std::_Exit(exit_interrupted);
  }
}

/// Ends the process 0.5 s after an interrupt if it has not ended by itself, because some work (reading a large file,
/// drawing a figure) does not check for interrupts.
void end_when_interrupted() {
  constexpr auto patience = std::chrono::milliseconds(500);
  constexpr auto step = std::chrono::milliseconds(20);
  while (sem_wait(&interrupt_came) != 0 && errno == EINTR) {
  }
  for (auto waited = step; waited < patience; waited += step) {
    std::this_thread::sleep_for(step);
    if (savers > 0) waited = step;
  }
  std::fprintf(stderr, "odosplat: %s\n", Interrupted().what());
  std::_Exit(exit_interrupted);
}

}  // namespace

void catch_interrupts() {
  sem_init(&interrupt_came, 0, 0);
  std::thread(end_when_interrupted).detach();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
  if (std::signal(SIGHUP, SIG_IGN) != SIG_IGN) std::signal(SIGHUP, on_interrupt);
  std::signal(SIGXFSZ, SIG_IGN);  // writing beyond the file size limit then fails with an error instead of a signal
}

bool interrupted() { return interrupt_flag; }

SavesWhenInterrupted::SavesWhenInterrupted() { ++savers; }
SavesWhenInterrupted::~SavesWhenInterrupted() { --savers; }

}  // namespace odosplat::apps
