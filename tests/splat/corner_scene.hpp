// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/train/trainer.hpp"

namespace odosplat::test {

/// A scene with exact depth and colour: the wall z = 2 m above the floor y = 0.5 m (y is down), both with a smooth
/// pattern, seen by cameras near the origin that look along z and slightly down.
struct CornerScene {
  Camera camera{64, 48, 60.0, 60.0, 31.5, 23.5};

  /// Pose k of a walk sideways, any k.
  SE3 T_world_camera(int k) const;
  /// z along the optical axis [m] and colour, by intersection of each pixel's ray with the two planes.
  DepthImage depth(const SE3& T_world_camera) const;
  ColorImage color(const SE3& T_world_camera) const;
  /// Points on both planes every `spacing` m, with colours and normals.
  PointCloud cloud(double spacing) const;
};

/// Training views at the even poses of the walk (0, 2, ...); the odd ones are for testing.
class CornerViews : public TrainingViews {
 public:
  explicit CornerViews(int count);
  int count() const override { return static_cast<int>(images_.size()); }
  Camera camera(int) const override { return scene_.camera; }
  SE3 T_world_camera(int i) const override { return scene_.T_world_camera(2 * i); }
  ColorImage color(int i) override { return images_[static_cast<std::size_t>(i)]; }

 private:
  CornerScene scene_;
  std::vector<ColorImage> images_;
};

/// Root mean square depth difference [m] over pixels where both have depth; `valid`: the share of such pixels.
double depth_rmse(const DepthImage& depth, const DepthImage& truth, double& valid);
double psnr_db(const ColorImage& image, const ColorImage& truth);

}  // namespace odosplat::test
