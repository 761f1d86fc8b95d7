// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "odosplat/odometry/keyframe/keyframe_backend.hpp"

namespace odosplat {

/// A keyframe that was asked for, and what came of it.
struct FinishedKeyframe {
  KeyframeRequest request;
  KeyframeOutcome outcome;
  std::vector<StageTime> stages;  // of the back end, so far
};

/// The back end on a thread of its own. At most one request waits, at most one is in the making, and the result of one
/// must be taken before another is begun: nothing grows, however slow the back end is. What it throws is thrown again
/// by take() or wait(), and the thread goes on. All calls from one thread, the front end's; the back end and its map
/// belong to the inner thread from construction on, except while idle() holds.
class KeyframeThread {
 public:
  /// backend must outlive this, and nobody else may use it or its map.
  explicit KeyframeThread(KeyframeBackend& backend);
  /// Finishes the keyframe in the making, if there is one; drops what waits.
  ~KeyframeThread();
  KeyframeThread(const KeyframeThread&) = delete;
  KeyframeThread& operator=(const KeyframeThread&) = delete;

  /// Asks for a keyframe, in the place of a request that has not been begun yet. Returns at once; false, and nothing is
  /// changed, if one is in the making or waits to be taken. Keyframes are numbered by this thread.
  bool request(KeyframeRequest request);

  /// Hands on a tracked frame for KeyframeBackend::trace, which a keyframe asked for later will have seen. Of those
  /// that the back end has no time for, the oldest are dropped.
  void observe(TrackedImage image);

  /// Asks for the map to be rendered where the next keyframe will probably be.
  void prefetch(const SE3& T_world_camera);

  /// The keyframe that was finished since the last call, if any.
  std::optional<FinishedKeyframe> take();

  /// Waits until nothing is asked for any more, then as take(). Until the next call of request(), observe() or
  /// prefetch() the back end and its map are the caller's.
  std::optional<FinishedKeyframe> wait();

 private:
  void run();
  bool idle() const { return !making_ && !busy_ && !waiting_ && !predicted_ && observed_.empty(); }
  std::optional<FinishedKeyframe> take_locked();

  KeyframeBackend& backend_;
  int made_ = 0;  // keyframes; the inner thread's
  std::mutex mutex_;
  std::condition_variable wake_;  // something is asked for
  std::condition_variable rest_;  // something is done
  std::optional<KeyframeRequest> waiting_;
  std::optional<SE3> predicted_;
  std::deque<TrackedImage> observed_;
  std::optional<FinishedKeyframe> finished_;
  std::exception_ptr failure_;
  bool making_ = false;
  bool busy_ = false;  // with something else
  bool stop_ = false;
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace odosplat
