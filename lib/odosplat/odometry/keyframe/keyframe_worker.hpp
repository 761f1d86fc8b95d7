// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <vector>

#include "odosplat/odometry/keyframe/keyframe_backend.hpp"

namespace odosplat {

/// A keyframe that was asked for, and the result.
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

  /// Asks for a keyframe. Returns the result, or none if it is made later: then take() or wait() returns it. If one is
  /// in the making or waits to be taken, the request is dropped. wait: return only when the keyframe was made or turned
  /// out not to be one.
  virtual std::optional<FinishedKeyframe> make(KeyframeRequest request, bool wait) = 0;

  /// Hands on a tracked frame for KeyframeBackend::trace, which is done before any keyframe that is asked for later.
  virtual void observe(TrackedImage image) = 0;

  /// Whether the map can be rendered ahead while frames are tracked.
  virtual bool renders_ahead() const = 0;
  /// Asks for the map to be rendered where the next keyframe will probably be; nothing if !renders_ahead().
  virtual void prefetch(const SE3& T_world_camera) = 0;

  /// The keyframe that was finished since the last call and not returned by make(), if any.
  virtual std::optional<FinishedKeyframe> take() = 0;

  /// Waits until nothing is left to do, then as take(). Until the next call of another function the caller may use the
  /// back end and its map.
  virtual std::optional<FinishedKeyframe> wait() = 0;

  /// Times of the back end's stages, at least up to the last keyframe that was returned.
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
