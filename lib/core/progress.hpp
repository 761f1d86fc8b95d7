// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <string>

namespace odosplat {

/// Progress of a long job on standard error: a line that is redrawn on a terminal (at most 10 times a second), a plain
/// line every 10 % or 30 s elsewhere. Shows done/total, time left and a text of the caller's. Not thread safe.
class Progress {
 public:
  /// what: a word or two ("train"). total >= 0 steps, of which the first `before` were done by an earlier run: the time
  /// left follows from the others' speed.
  Progress(std::string what, long total, long before = 0);
  /// Ends the line; also done by the destructor.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// done steps of total; detail is shown behind the bar ("loss 0.041  PSNR 27.3 dB").
  void update(long done, const std::string& detail = "");
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void print(long done, const std::string& detail);

  std::string what_;
  long total_;
  long before_;
  bool terminal_;
  bool finished_ = false;
  bool line_open_ = false;
  long last_done_ = 0;
  long next_plain_ = 0;
  Clock::time_point start_;
  Clock::time_point last_print_;
};

/// "1:02:03" or "2:03" for a duration [s].
std::string format_duration(double seconds);

}  // namespace odosplat
