// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include "odosplat/map/map_view.hpp"

namespace odosplat {

struct SensorViewOptions {
  double sigma_constant = 0.0012;  // [m] standard deviation of depths up to `nearest`
  double sigma_square = 0.0019;    // [1/m] growth with the square of the depth beyond `nearest`
  double nearest = 0.4;            // [m] depth at which that growth begins

  void check() const;

  /// Standard deviation [m] of a measured depth z [m].
  double sigma(double z) const {
    const double beyond = z > nearest ? z - nearest : 0.0;
    return sigma_constant + sigma_square * beyond * beyond;
  }
};

/// A depth sensor used in place of a map, for an RGB-D baseline: render() returns the depth image that was set,
/// whatever the pose, so the depth of every frame must be set before that frame is tracked.
/// sigma(z) = sigma_constant + sigma_square (z - nearest)^2: Nguyen, Izadi, Lovell 2012, "Modeling Kinect sensor
/// noise", equation 2. alpha is 1 where there is depth. No colour.
class SensorView : public MapView {
 public:
  explicit SensorView(const SensorViewOptions& options = {});

  /// depth [m]; values that are not finite or not positive count as no depth. The image is copied. After an empty image
  /// there is no depth until the next call.
  void set_depth(const DepthImage& depth);

  /// camera must have the size of the depth image, else InputError.
  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override;
  std::string name() const override { return "sensor"; }

 private:
  SensorViewOptions options_;
  DepthImage depth_;
};

}  // namespace odosplat
