// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/map.hpp"

namespace odosplat::python {

/// A map as Python holds it: read-only, with what renders it on each device, made when it is first needed.
class HeldMap {
 public:
  explicit HeldMap(Map map) : map_(std::move(map)) {}

  const Map& map() const { return map_; }
  /// Where the training images were taken; sampled places where the map does not say.
  std::vector<SE3> places() const;
  /// One thread at a time; others wait.
  ViewImages render(const std::string& device, const std::string& depth, const Camera& camera,
                    const SE3& T_world_camera);

 private:
  const Map map_;
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, std::unique_ptr<GaussianView>> views_;  // by device and kind of depth
};

}  // namespace odosplat::python
