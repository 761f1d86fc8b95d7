// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/least_size.hpp"

#include <algorithm>
#include <string>

#include "odosplat/core/error.hpp"

namespace odosplat {

void check_least_size(const Camera& camera) {
  constexpr int least_side = 16;
  require(std::min(camera.width, camera.height) >= least_side, "images",
          "at least 16x16 pixels for tracking and relocalisation, are " + std::to_string(camera.width) + "x" +
              std::to_string(camera.height));
}

}  // namespace odosplat
