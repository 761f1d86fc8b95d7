// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <vector>

#include "odosplat/odometry/keyframe/keyframe_backend.hpp"

namespace odosplat {

/// A keyframe that was asked for, and what came of it.
struct FinishedKeyframe {
  KeyframeRequest request;
  KeyframeOutcome outcome;
  std::vector<StageTime> stages;  // of the back end, so far
};

/// Makes keyframes by the back end: within the caller's call (InlineKeyframes) or on a thread (KeyframeThread). It
/// numbers them. All calls from one thread.
class KeyframeWorker {
 public:
  virtual ~KeyframeWorker() = default;

  /// Asks for a keyframe. Returned is what came of it, or none where it is made later: then take() or wait() has it. If
  /// one is in the making or waits to be taken, the request is dropped. wait: do not return before it is made, or was
  /// found not to be one.
  virtual std::optional<FinishedKeyframe> make(KeyframeRequest request, bool wait) = 0;

  /// Hands on a tracked frame for KeyframeBackend::trace, which a keyframe asked for later will have seen.
  virtual void observe(TrackedImage image) = 0;

  /// Whether the map can be rendered ahead while frames are tracked.
  virtual bool renders_ahead() const = 0;
  /// Asks for the map to be rendered where the next keyframe will probably be; nothing if !renders_ahead().
  virtual void prefetch(const SE3& T_world_camera) = 0;

  /// The keyframe that was finished since the last call and not returned by make(), if any.
  virtual std::optional<FinishedKeyframe> take() = 0;

  /// Waits until nothing is asked for any more, then as take(). Until the next call of another function the back end
  /// and its map are the caller's.
  virtual std::optional<FinishedKeyframe> wait() = 0;

  /// Times of the back end's stages, up to the last keyframe that was returned at least.
  virtual std::vector<StageTime> stages() const = 0;

 protected:
  KeyframeWorker() = default;
  KeyframeWorker(const KeyframeWorker&) = default;
  KeyframeWorker& operator=(const KeyframeWorker&) = default;
};

/// Makes each keyframe when it is asked for: same input, same bits.
class InlineKeyframes : public KeyframeWorker {
 public:
  /// backend must outlive this.
  explicit InlineKeyframes(KeyframeBackend& backend) : backend_(backend) {}

  std::optional<FinishedKeyframe> make(KeyframeRequest request, bool wait) override;
  void observe(TrackedImage image) override { backend_.trace(image); }
  bool renders_ahead() const override { return false; }
  void prefetch(const SE3&) override {}
  std::optional<FinishedKeyframe> take() override { return std::nullopt; }
  std::optional<FinishedKeyframe> wait() override { return std::nullopt; }
  std::vector<StageTime> stages() const override { return backend_.stages(); }

 private:
  KeyframeBackend& backend_;
  int made_ = 0;
};

}  // namespace odosplat
