// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/terminal_text.hpp"

namespace odosplat {

std::string format_duration(double seconds) {
  const long s = std::isfinite(seconds) ? std::lround(std::max(0.0, seconds)) : 0;
  if (s >= 3600) return formatted("%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  return formatted("%ld:%02ld", s / 60, s % 60);
}

std::optional<double> TimeLeft::update(long done, double now) {
  if (!first_done_) {
    first_done_ = done;
    first_time_ = now;
  }
  if (done >= total_) return 0.0;
  const long steps = done - *first_done_;
  const double seconds = now - first_time_;
  const bool enough = 100 * steps >= total_ - *first_done_ || seconds >= 20.0;
  if (steps < 1 || seconds < 3.0 || !enough) return std::nullopt;
  return seconds * static_cast<double>(total_ - done) / static_cast<double>(steps);
}

Progress::Progress(const std::string& what, long total)
    : what_(printable_line(what)),
      total_(total),
      shown_(logs_info()),
      terminal_(isatty(STDERR_FILENO) == 1),
      time_left_(total),
      start_(Clock::now()),
      last_print_(start_) {}

Progress::~Progress() { finish(); }

void Progress::update(long done, const std::string& detail) {
  if (!shown_) return;
  const auto now = Clock::now();
  const bool counted = total_ != unknown;
  const std::optional<double> left = time_left_.update(done, std::chrono::duration<double>(now - start_).count());
  const double since = std::chrono::duration<double>(now - last_print_).count();
  const bool last = counted && done >= total_;
  if (terminal_ ? (since >= 0.1 || last) : (done >= next_plain_ || since >= 30.0 || last)) {
    if (!terminal_) next_plain_ = counted ? done + std::max(1L, total_ / 10) : std::numeric_limits<long>::max();
    last_print_ = now;
    print(done, left ? format_duration(*left) : "-:--", printable_line(detail));
  }
}

void Progress::print(long done, const std::string& left, const std::string& detail) {
  const std::string numbers =
      std::to_string(done) + (total_ == unknown ? "" : "/" + std::to_string(total_) + "  left " + left);
  if (terminal_ && total_ == unknown) {
    const std::string line = what_ + " " + numbers + "  " + detail;
    std::fprintf(stderr, "\r\033[K%s", cut_to_columns(line, terminal_columns(STDERR_FILENO) - 1).c_str());
    line_open_ = true;
  } else if (terminal_) {
    // The last column stays free: filling it would make the terminal move to the next line.
    const int columns = terminal_columns(STDERR_FILENO) - 1;
    const double share = total_ > 0 ? static_cast<double>(done) / static_cast<double>(total_) : 1.0;
    const int room = columns - text_columns(what_ + " [] " + numbers + "  " + detail);
    const int width = std::clamp(room, 10, 24);
    const int filled = std::clamp(static_cast<int>(share * width), 0, width);
    const std::string bar =
        std::string(static_cast<std::size_t>(filled), '#') + std::string(static_cast<std::size_t>(width - filled), '.');
    const std::string line = what_ + " [" + bar + "] " + numbers + (detail.empty() ? "" : "  " + detail);
    std::fprintf(stderr, "\r\033[K%s", cut_to_columns(line, columns).c_str());
    line_open_ = true;
  } else {
    std::fprintf(stderr, "%s %s  %s\n", what_.c_str(), numbers.c_str(), detail.c_str());
  }
  std::fflush(stderr);
}

void Progress::finish() {
  if (finished_) return;
  finished_ = true;
  if (line_open_) std::fputc('\n', stderr);
}

}  // namespace odosplat
