// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/live_options.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {

void LiveOptions::check() const {
  require(std::isfinite(open_timeout) && open_timeout > 0.0, "open_timeout", "finite and positive [s]");
  require(std::isfinite(stall_timeout) && stall_timeout > 0.0, "stall_timeout", "finite and positive [s]");
  require(std::isfinite(reconnect) && reconnect >= 0.0, "reconnect", "finite, at least 0 [s]");
  require(max_pixels >= 1, "max_pixels", "at least 1");
}

}  // namespace odosplat
