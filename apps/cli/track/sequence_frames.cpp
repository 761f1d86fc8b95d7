// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/track/sequence_frames.hpp"

#include "odosplat/core/error.hpp"

namespace odosplat::apps {

InputFrame frame_of(const Sequence& sequence, std::size_t i) {
  InputFrame frame;
  frame.number = i;
  frame.time = sequence.time(i);
  frame.stamp = sequence.time_text(i);
  return frame;
}

std::shared_ptr<SensorView> sensor_view_of(OpenedView& opened, const Sequence& sequence, std::size_t i) {
  if (opened.sensor == nullptr) return nullptr;
  opened.show_frame(sequence, i);
  return std::make_shared<SensorView>(*opened.sensor);
}

SequenceFrames::SequenceFrames(const Sequence& sequence, const FrameRange& range, OpenedView& opened, bool realtime)
    : sequence_(sequence),
      range_(range),
      opened_(opened),
      realtime_(realtime),
      reader_(sequence, range),
      next_(range.begin) {}

void SequenceFrames::start() {
  if (realtime_) playback_.emplace(sequence_, range_);
}

std::optional<InputFrame> SequenceFrames::next(const std::function<bool()>& stopped) {
  if (stopped()) return std::nullopt;
  std::optional<std::size_t> i;
  if (playback_) {
    i = playback_->next(stopped);
  } else if (next_ < range_.end) {
    i = next_++;
  }
  if (!i) return std::nullopt;
  InputFrame frame = frame_of(sequence_, *i);
  frame.dropped = playback_ ? playback_->dropped() : 0;
  try {
    frame.view = sensor_view_of(opened_, sequence_, *i);
    frame.image = reader_.take(*i);
  } catch (const InputError& e) {
    frame.fault = e.what();
  }
  return frame;
}

}  // namespace odosplat::apps
