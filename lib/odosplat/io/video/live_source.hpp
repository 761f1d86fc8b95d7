// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "odosplat/io/video/live_options.hpp"

namespace odosplat {

/// An image of a live source.
struct LiveFrame {
  cv::Mat3b rgb;      // as it is to be shown (rotated as the stream says), with the lens distortion of the camera
  double time = 0.0;  // [s] when it was taken, on the steady clock: see LiveSource
  std::chrono::steady_clock::time_point arrival;  // when it was decoded
  std::size_t number = 0;                         // of the images since start(), counted from 0, dropped ones included
  std::size_t dropped = 0;                        // images dropped since the last one taken
};

/// Sums since start().
struct LiveCounts {
  std::size_t images = 0;   // that arrived
  std::size_t dropped = 0;  // of them: replaced by a newer one before they were taken
  std::size_t damaged = 0;  // left out, as they were decoded from damaged data or could not be decoded
  std::size_t reconnections = 0;
};

/// Images as they come: from a camera of this machine ("/dev/video0", through Video4Linux), from an address that FFmpeg
/// opens (rtsp://, http://, udp://, tcp://, ...; RTSP over TCP where the server offers it), or from a pipe that carries a
/// container, such as MPEG-TS, Matroska or YUV4MPEG ("-": standard input; the path of a FIFO).
///
/// A thread decodes every image as it comes and keeps the newest alone: a caller that is late gets that one, and older
/// ones are dropped and counted. The memory needed does not depend on time or on the caller.
///
/// Time: the stream's presentation stamps, moved to std::chrono::steady_clock (on Linux: seconds since the machine was
/// started) by the least delay seen between stamp and arrival (StreamClock): a constant delay of camera and network is
/// part of the time. Streams without stamps (bare H.264, MJPEG) have the time of arrival. Times increase always and are
/// multiples of 1 us.
///
/// A network source or camera that closes, fails, or is silent for stall_timeout is lost: a warning says so, and it is
/// opened again after pauses of 0.5 s to 4 s, until options.reconnect seconds have passed since; then it has ended. A pipe
/// ends when its writers close it, or when it has been silent for stall_timeout + reconnect, with a warning after
/// stall_timeout. Passwords in addresses are never shown (shown_address).
/// take() and counts() may be called from one thread at a time.
class LiveSource {
 public:
  /// Opens the source and waits for its first image, or until `stopped` returns true (asked every 20 ms; Interrupted is
  /// thrown then). Throws InputError of one line with the address and the reason: it cannot be opened, holds no video,
  /// or gives no image within open_timeout.
  explicit LiveSource(const std::string& source, const LiveOptions& options = {},
                      const std::function<bool()>& stopped = {});
  ~LiveSource();
  LiveSource(const LiveSource&) = delete;
  LiveSource& operator=(const LiveSource&) = delete;

  /// The address without a password.
  const std::string& name() const;
  /// Size of the images as they came first [px]. A source that is opened again may give another.
  cv::Size size() const;
  /// Clockwise quarter turns by which images are rotated, as the stream says, 0 to 3.
  int quarters() const;

  /// To be called when the caller is ready, before the first take(). Images that came earlier do not count as dropped;
  /// a pipe is not read beyond its first image before.
  void start();
  /// Waits for an image newer than the last one taken. Nothing: none came within that time [s], or the source has
  /// ended.
  std::optional<LiveFrame> take(double seconds);
  /// True once no image follows.
  bool ended() const;
  LiveCounts counts() const;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace odosplat
