// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>

#include "apps/cli/track/frame_reader.hpp"
#include "apps/cli/track/frame_source.hpp"
#include "apps/cli/track/playback.hpp"
#include "apps/input/map_views.hpp"

namespace odosplat::apps {

/// The frames of a recorded sequence: every one in order, or in real time the newest that is due (Playback).
class SequenceFrames : public FrameSource {
 public:
  /// opened: its depth sensor, if there is one, shows each frame's depth image. All must outlive this.
  SequenceFrames(const Sequence& sequence, const FrameRange& range, OpenedView& opened, bool realtime);

  const std::string& name() const override { return sequence_.name(); }
  const Camera& camera() const override { return sequence_.camera(); }
  std::optional<std::size_t> size() const override { return range_.end - range_.begin; }
  void start() override;
  std::optional<InputFrame> next(const std::function<bool()>& stopped) override;

 private:
  const Sequence& sequence_;
  const FrameRange range_;
  OpenedView& opened_;
  const bool realtime_;
  FrameReader reader_;
  std::optional<Playback> playback_;  // in real time, from start() on
  std::size_t next_;
};

/// Frame i without its image.
InputFrame frame_of(const Sequence& sequence, std::size_t i);

/// Sets the frame's depth image in a sensor's view and returns a copy of the view, because a keyframe made later from
/// this frame still needs its depth; null for maps.
std::shared_ptr<SensorView> sensor_view_of(OpenedView& opened, const Sequence& sequence, std::size_t i);

}  // namespace odosplat::apps
