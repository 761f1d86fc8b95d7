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

/// Reads grey images of a sequence's frames in a range, in order on a thread of its own, ahead of whoever uses them,
/// and keeps at most `ahead` of them. What reading a frame throws is thrown by the take() that wants it. take() from
/// one thread.
class FrameReader {
 public:
  explicit FrameReader(const Sequence& sequence, const FrameRange& range = {}, std::size_t ahead = 8);
  ~FrameReader();
  FrameReader(const FrameReader&) = delete;
  FrameReader& operator=(const FrameReader&) = delete;

  /// Frame i, waiting until it is read; i must grow from call to call. Frames before it that were not taken are given
  /// up, those not yet read without reading them.
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
  std::size_t wanted_ = 0;     // no frame before this one is
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace odosplat::apps
