// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/map/map_view.hpp"

namespace odosplat {

struct SensorViewOptions {
  double sigma_constant = 0.0012;  // [m] deviation of near depths
  double sigma_square = 0.0019;    // [1/m] growth with the square of the depth beyond `nearest`
  double nearest = 0.4;            // [m] where that growth begins

  void check() const;

  /// [m] of a measured depth z [m].
  double sigma(double z) const {
    const double beyond = z > nearest ? z - nearest : 0.0;
    return sigma_constant + sigma_square * beyond * beyond;
  }
};

/// A depth sensor in the place of a map, for an RGB-D baseline: what render() gives is the depth image that was set,
/// whatever the pose, so it must be set anew for every frame before the frame is tracked.
/// sigma(z) = sigma_constant + sigma_square (z - nearest)^2: Nguyen, Izadi, Lovell 2012, "Modeling Kinect sensor
/// noise", equation 2. alpha is 1 where there is depth. No colour.
class SensorView : public MapView {
 public:
  explicit SensorView(const SensorViewOptions& options = {});

  /// depth [m]; values that are not finite or not positive count as none. Shares nothing with the caller's image.
  /// An empty image: no depth until the next call.
  void set_depth(const DepthImage& depth);

  /// camera must have the size of the depth image, else InputError.
  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  std::string name() const override { return "sensor"; }

 private:
  SensorViewOptions options_;
  DepthImage depth_;
};

}  // namespace odosplat
