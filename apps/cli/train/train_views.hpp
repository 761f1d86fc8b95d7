// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "apps/input/frame_range.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/splat/train/training_targets.hpp"

namespace odosplat::apps {

/// Every Nth posed frame of some sequences, read from disk when requested. Frames whose image cannot be read are left
/// out, with one warning; a damaged depth image counts as missing.
class SequenceViews : public TrainingViews {
 public:
  /// Reads every image once to check it. InputError for a sequence that cannot be read or has no such frame.
  SequenceViews(std::vector<Sequence> sequences, int every, const FrameRange& range);

  int count() const override { return static_cast<int>(frames_.size()); }
  Camera camera(int i) const override { return sequence(i).camera(); }
  SE3 T_world_camera(int i) const override { return *sequence(i).T_world_camera(at(i).frame); }
  ColorImage color(int i) override { return sequence(i).color(at(i).frame); }
  DepthImage depth(int i) override;

  /// Sequence and frame number of view i.
  std::string sequence_name(int i) const { return sequence(i).name(); }
  std::size_t frame(int i) const { return at(i).frame; }
  const std::vector<Sequence>& sequences() const { return sequences_; }

 private:
  struct Place {
    std::size_t sequence;
    std::size_t frame;
  };
  const Place& at(int i) const { return frames_[static_cast<std::size_t>(i)]; }
  const Sequence& sequence(int i) const { return sequences_[at(i).sequence]; }

  std::vector<Sequence> sequences_;
  std::vector<Place> frames_;
};

}  // namespace odosplat::apps
