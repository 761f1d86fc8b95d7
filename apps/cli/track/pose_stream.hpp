// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "apps/cli/track/frame_source.hpp"
#include "odosplat/odometry/odometry.hpp"

namespace odosplat::apps {

/// Sends lines of text to standard output or, each in a datagram of its own, to a UDP address, on its own thread: send()
/// never waits. At most 1000 lines wait for a slow reader, then new ones are dropped and counted, with one warning. A
/// reader that closes its end of the pipe ends the stream, with one warning.
class PoseStream {
 public:
  /// where: "-" or "udp://HOST:PORT" ("udp://[::1]:9000" for IPv6). InputError for other text, and for a host that is
  /// not known.
  explicit PoseStream(const std::string& where);
  ~PoseStream();
  PoseStream(const PoseStream&) = delete;
  PoseStream& operator=(const PoseStream&) = delete;

  /// line: without its end.
  void send(const std::string& line);
  /// Waits until all lines are sent, at most 0.3 s; those that are left count as dropped.
  void finish();

  const std::string& where() const { return where_; }
  std::size_t sent() const;
  std::size_t dropped() const;

 private:
  enum class Sending { done, not_yet, refused, closed };

  void run();
  Sending write_some(std::string& line) const;
  Sending send_datagram(const std::string& line) const;
  void drop(const std::string& reason);

  const std::string where_;
  bool datagrams_ = false;
  int file_ = -1;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::string> lines_;
  std::size_t sent_ = 0;
  std::size_t dropped_ = 0;
  bool stop_ = false;
  bool closed_ = false;
  bool idle_ = true;    // the thread has sent all that it took
  std::thread thread_;  // declared last: the thread uses all members above
};

/// One frame as a line of JSON (docs/formats.md). result: null if the image cannot be read. latency_ms: of live sources.
std::string pose_line(const InputFrame& frame, const TrackResult* result, std::optional<double> latency_ms);

}  // namespace odosplat::apps
