// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/keyframe/keyframe_worker.hpp"

#include <utility>

namespace odosplat {

std::optional<FinishedKeyframe> InlineKeyframes::make(KeyframeRequest request, bool /*wait*/) {
  request.id = made_;
  FinishedKeyframe finished{std::move(request), {}, {}};
  finished.outcome = backend_.add(finished.request);
  if (finished.outcome.made) ++made_;
  return finished;
}

}  // namespace odosplat
