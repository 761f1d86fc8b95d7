// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/train/train_views.hpp"

#include "apps/input/sequence_flags.hpp"
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

SequenceViews::SequenceViews(const std::vector<std::string>& paths, const SequenceOptions& options, int every,
                             const FrameRange& range) {
  UnreadableFrames unreadable;
  for (const std::string& path : paths) {
    sequences_.push_back(open_sequence(path, options));
    const std::vector<std::size_t> frames = posed_frames(sequences_.back(), every, range);
    const std::vector<std::string> faults = image_faults(sequences_.back(), frames);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      if (faults[k].empty()) {
        frames_.push_back({sequences_.size() - 1, frames[k]});
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
