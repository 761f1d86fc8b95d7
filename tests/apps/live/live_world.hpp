// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "tests/apps/run_program.hpp"

namespace odosplat::apps_test {

/// A tiny sequence with its cloud, and the same images as a YUV4MPEG stream in a FIFO, which a thread writes at a rate.
class LiveWorld {
 public:
  explicit LiveWorld(int frames);
  ~LiveWorld();
  LiveWorld(const LiveWorld&) = delete;
  LiveWorld& operator=(const LiveWorld&) = delete;

  /// Starts to write `images` images, `pause_ms` apart, as soon as there is a reader; then closes the FIFO or, if
  /// silent, leaves it open until the end.
  void play(std::size_t images, int pause_ms, bool silent = false);

  /// Words of `odosplat track SOURCE` that localise in the sequence's cloud, from the true pose of its first image.
  std::vector<std::string> track(const std::string& source, const std::vector<std::string>& more = {}) const;

  std::string sequence() const { return scratch_ / "seq"; }
  std::string camera() const { return scratch_ / "seq/camera.yaml"; }
  std::string fifo() const { return scratch_ / "fifo"; }
  std::string out() const { return scratch_ / "run"; }
  std::string file(const std::string& name) const { return scratch_ / name; }
  const Trajectory& truth() const { return truth_; }

 private:
  ScratchFolder scratch_;
  Trajectory truth_;
  std::vector<std::string> images_;  // of the stream
  std::string header_;
  std::atomic<bool> stop_{false};
  std::thread writer_;
};

/// A UDP socket of the loopback interface, and a thread that collects what comes.
class UdpReader {
 public:
  UdpReader();
  ~UdpReader();
  UdpReader(const UdpReader&) = delete;
  UdpReader& operator=(const UdpReader&) = delete;

  std::string address() const { return "udp://127.0.0.1:" + std::to_string(port_); }
  std::size_t lines() const { return count_; }
  /// Ends the collecting; one text per datagram.
  std::vector<std::string> finish();

 private:
  int file_;
  int port_ = 0;
  std::vector<std::string> lines_;
  std::atomic<std::size_t> count_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace odosplat::apps_test
