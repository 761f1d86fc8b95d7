// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <mutex>
#include <thread>

#include "apps/input/sequence_flags.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/io/sequence/sequence.hpp"

namespace odosplat::apps {

/// Reads the grey images of a range of frames in order on its own thread, up to `ahead` images before they are taken.
/// An exception from reading a frame is thrown by the take() of that frame. take() must be called from one thread.
class FrameReader {
 public:
  explicit FrameReader(const Sequence& sequence, const FrameRange& range = {}, std::size_t ahead = 8);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Waits for frame i and returns it; i must grow from call to call. Skipped frames are discarded, or not read at all
  /// if reading them has not begun.
  GrayImage take(std::size_t i);

 private:
  struct Entry {
    std::size_t index = 0;
    GrayImage gray;
    std::exception_ptr failure;
  };

  void run();
  Entry read(std::size_t i) const;

  const Sequence sequence_;
  const FrameRange range_;
  const std::size_t ahead_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Entry> entries_;  // in order
  std::size_t wanted_ = 0;     // frames before this one are not wanted
  bool stop_ = false;
  std::thread thread_;  // declared last: the thread uses all members above
};

}  // namespace odosplat::apps
