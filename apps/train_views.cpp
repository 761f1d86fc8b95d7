// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "train_views.hpp"

namespace odosplat::apps {

SequenceViews::SequenceViews(const std::vector<std::string>& paths, const SequenceOptions& options, int every,
                             const FrameRange& range) {
  for (const std::string& path : paths) {
    sequences_.push_back(Sequence::open(path, options));
    for (const std::size_t frame : posed_frames(sequences_.back(), every, range))
      frames_.push_back({sequences_.size() - 1, frame});
  }
}

}  // namespace odosplat::apps
