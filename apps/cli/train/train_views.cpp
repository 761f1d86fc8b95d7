// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/train/train_views.hpp"

#include <utility>

#include "apps/input/unreadable_frames.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat::apps {
namespace {

/// Reads every frame's image and returns the fault of each; empty: none.
std::vector<std::string> image_faults(const Sequence& sequence, const std::vector<std::size_t>& frames) {
  std::vector<std::string> faults(frames.size());
  parallel_for(static_cast<int>(frames.size()), 1, [&](int begin, int end) {
    for (auto k = static_cast<std::size_t>(begin); k < static_cast<std::size_t>(end); ++k) {
      try {
        sequence.color(frames[k]);
      } catch (const InputError& e) {
        faults[k] = e.what();
      }
    }
  });
  return faults;
}

}  // namespace

SequenceViews::SequenceViews(std::vector<Sequence> sequences, int every, const FrameRange& range)
    : sequences_(std::move(sequences)) {
  UnreadableFrames unreadable;
  for (std::size_t s = 0; s < sequences_.size(); ++s) {
    const std::vector<std::size_t> frames = posed_frames(sequences_[s], every, range);
    const std::vector<std::string> faults = image_faults(sequences_[s], frames);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (faults[k].empty()) {
        frames_.push_back({s, frames[k]});
      } else {
        unreadable.add(faults[k]);
      }
    }
  }
  unreadable.report(unreadable.count() + frames_.size());
}

DepthImage SequenceViews::depth(int i) {
  if (!sequence(i).has_depth(at(i).frame)) return {};
  try {
    return sequence(i).depth(at(i).frame);
  } catch (const InputError& e) {
    log_warning(std::string(e.what()) + "; its depth is left out");
    return {};
  }
}

}  // namespace odosplat::apps
