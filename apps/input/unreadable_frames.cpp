// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/unreadable_frames.hpp"

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat::apps {

void UnreadableFrames::report(std::size_t frames) const {
  if (count_ == 0) return;
  const std::string share =
      std::to_string(count_) + " of " + std::to_string(frames) + " frames cannot be read, such as " + first_fault_;
  if (count_ == frames) throw InputError(share);
  log_warning(share + "; they are left out");
}

}  // namespace odosplat::apps
