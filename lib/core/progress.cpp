// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace odosplat {

std::string format_duration(double seconds) {
  const long s = std::isfinite(seconds) ? std::lround(std::max(0.0, seconds)) : 0;
  char text[64];
  if (s >= 3600) {
    std::snprintf(text, sizeof(text), "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  } else {
    std::snprintf(text, sizeof(text), "%ld:%02ld", s / 60, s % 60);
  }
  return text;
}

Progress::Progress(std::string what, long total, long before)
    : what_(std::move(what)),
      total_(total),
      before_(before),
      terminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      last_print_(start_) {}

Progress::~Progress() { finish(); }

void Progress::update(long done, const std::string& detail) {
  const auto now = Clock::now();
  const double since = std::chrono::duration<double>(now - last_print_).count();
  last_done_ = done;
  const bool last = done >= total_;
  if (terminal_ ? (since >= 0.1 || last) : (done >= next_plain_ || since >= 30.0 || last)) {
    if (!terminal_) next_plain_ = done + std::max(1L, total_ / 10);
    last_print_ = now;
    print(done, detail);
  }
}

void Progress::print(long done, const std::string& detail) {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1.0;
  const std::string left =
      done > before_
          ? format_duration(elapsed * static_cast<double>(total_ - done) / static_cast<double>(done - before_))
          : "-:--";
  if (terminal_) {
    constexpr int width = 24;
    const int filled = std::clamp(static_cast<int>(share * width), 0, width);
    const std::string bar =
        std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(width - filled), '.');
    std::fprintf(stderr, "\r\033[K%s [%s] %ld/%ld  left %s  %s", what_.c_str(), bar.c_str(), done, total_, left.c_str(),
                 detail.c_str());
    line_open_ = true;
  } else {
    std::fprintf(stderr, "%s %ld/%ld  left %s  %s\n", what_.c_str(), done, total_, left.c_str(), detail.c_str());
  }
  std::fflush(stderr);
}

void Progress::finish() {
  if (finished_) return;
  finished_ = true;
  if (line_open_) std::fputc('\n', stderr);
}

}  // namespace odosplat
