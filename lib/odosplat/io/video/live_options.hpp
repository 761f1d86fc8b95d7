// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace odosplat {

/// How a LiveSource is opened and waited for.
struct LiveOptions {
  cv::Size size;                          // [px] asked of a camera of this machine; empty: what it gives unasked
  std::int64_t max_pixels = 100'000'000;  // larger images are not decoded
  double open_timeout = 10.0;             // [s] until the first image, when the source is opened
  double stall_timeout = 5.0;             // [s] without an image after which the source counts as lost
  double reconnect = 60.0;                // [s] for which a lost source is tried again; 0: not at all

  /// Throws InputError for a time that is negative or not finite (open_timeout and stall_timeout: not positive).
  void check() const;
};

}  // namespace odosplat
