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

#include "odosplat/odometry/keyframe/keyframe_worker.hpp"

namespace odosplat {

/// The back end on a thread of its own. At most one request waits, at most one is in the making, and the result of one
/// must be taken before another is begun: the use of memory is bounded, however slow the back end is. Exceptions of the
/// back end are rethrown by take() or wait(), and the thread goes on. All calls must come from one thread, the front
/// end's; the back end and its map belong to the inner thread from construction on, except while idle() holds.
class KeyframeThread : public KeyframeWorker {
 public:
  /// backend must outlive this, and nobody else may use it or its map.
  explicit KeyframeThread(KeyframeBackend& backend);
  /// Finishes the keyframe in the making, if there is one; drops what waits.
  ~KeyframeThread() override;
  KeyframeThread(const KeyframeThread&) = delete;
  KeyframeThread& operator=(const KeyframeThread&) = delete;

  /// Asks for a keyframe, in the place of a request that has not been begun yet. Returns at once; false, and nothing is
  /// changed, if one is in the making or waits to be taken. Keyframes are numbered by this thread.
  bool request(KeyframeRequest request);

  std::optional<FinishedKeyframe> make(KeyframeRequest wanted, bool to_wait) override;

  /// Of the frames that the back end has no time for, the oldest are dropped.
  void observe(TrackedImage image) override;

  bool renders_ahead() const override { return true; }
  void prefetch(const SE3& T_world_camera) override;
  std::optional<FinishedKeyframe> take() override;
  std::optional<FinishedKeyframe> wait() override;
  std::vector<StageTime> stages() const override { return stages_; }

 private:
  void run();
  bool idle() const { return !making_ && !busy_ && !waiting_ && !predicted_ && observed_.empty(); }
  std::optional<FinishedKeyframe> take_locked();

  KeyframeBackend& backend_;
  int made_ = 0;                   // number of keyframes made; used by the inner thread only
  std::vector<StageTime> stages_;  // as of the last keyframe that was taken; used by the front end only
  std::mutex mutex_;
  std::condition_variable wake_;  // something is asked for
  std::condition_variable rest_;  // something is done
  std::optional<KeyframeRequest> waiting_;
  std::optional<SE3> predicted_;
  std::deque<TrackedImage> observed_;
  std::optional<FinishedKeyframe> finished_;
  std::exception_ptr failure_;
  bool making_ = false;
  bool busy_ = false;  // with anything but a keyframe
  bool stop_ = false;
  std::thread thread_;  // declared last: it uses all of the above
};

}  // namespace odosplat
