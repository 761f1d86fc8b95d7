// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace odosplat {

/// Time left of a job, estimated from the speed of its own steps. The clock starts at the first report: the time before
/// it (building kernels, reading) would make the first estimates much too long.
class TimeLeft {
 public:
  explicit TimeLeft(long total) : total_(total) {}
  /// `done` steps have been done at time `now` [s, any start]. Returns the remaining time [s]; 0 when all steps are
  /// done; nullopt until at least 3 s, and either 1 % of the steps or 20 s, have been measured.
  std::optional<double> update(long done, double now);

 private:
  long total_;
  std::optional<long> first_done_;
  double first_time_ = 0.0;
};

/// Progress of a long job on standard error: a line that is redrawn on a terminal (at most 10 times a second, cut to
/// the terminal's width), a plain line every 10 % or 30 s elsewhere. Shows done/total, the time left ("-:--" until
/// TimeLeft gives one) and a text of the caller's. Shows nothing if the log level hides log_info (set_log_level). Not
/// thread safe.
class Progress {
 public:
  static constexpr long unknown = -1;
  /// what: a word or two ("train"). total: number of steps, or `unknown`: neither bar nor time left is shown, and plain
  /// lines at the first update and every 30 s. The time left follows from the steps after the first update.
  Progress(const std::string& what, long total);
  /// Ends the line; also done by the destructor.
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// done steps of total; detail is shown behind the bar ("loss 0.041  PSNR 27.3 dB").
  void update(long done, const std::string& detail = "");
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  void print(long done, const std::string& left, const std::string& detail);

  std::string what_;
  long total_;
  bool shown_;
  bool terminal_;
  bool finished_ = false;
  bool line_open_ = false;
  long next_plain_ = 0;
  TimeLeft time_left_;
  Clock::time_point start_;
  Clock::time_point last_print_;
};

/// "1:02:03" or "2:03" for a duration [s].
std::string format_duration(double seconds);

}  // namespace odosplat
