// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>

#include "odosplat/camera/camera.hpp"
#include "odosplat/cloud/voxel_grid.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

struct CloudOptions {
  double voxel = 0.03;           // [m] edge of a voxel; one point a voxel is kept
  double noise = 0.0;            // [m] standard deviation of the range noise that each final point shall have
  std::uint64_t seed = 0;        // of the noise
  double min_depth = 0.1;        // [m] nearer depths are not used
  double max_depth = 20.0;       // [m] farther depths are not used
  double max_depth_step = 0.03;  // [1] share of a pixel's depth by which a neighbour may be nearer
  double max_incidence = 80.0;   // [deg] largest angle between the viewing ray and the surface's normal
  int normal_neighbors = 16;     // neighbours a normal is fitted to; 0: no normals

  void check() const;
};

/// Makes a point cloud from posed depth images, as a scanner would have left it: the input of the trainer and of the
/// interpolation view.
///
/// Every pixel with depth in range becomes a point in the world, and the points of a voxel become one, their mean.
/// Left out are pixels beside a nearer neighbour (behind an occluding edge, where sensors mix the two depths and
/// colours; the near side is kept, so that thin things survive) and those seen at a grazing angle.
///
/// Noise: the mean of a voxel's points would hide noise that is put on each pixel, so it is put on the final points:
/// each moves by a normal deviate times `noise` along the mean ray it was seen by, like the range error of a scanner
/// that took one shot a voxel. Normals are fitted afterwards, to the points as they are, and face the cameras.
///
/// Memory grows with the voxels, not with the images. Deterministic; not thread safe.
class CloudBuilder {
 public:
  explicit CloudBuilder(const CloudOptions& options);

  /// depth [m], of the camera's size; color of the same size, or empty for all images. Throws InputError for other
  /// sizes, a bad camera, a pose that is not finite, or colour in some images only. No depth: nothing happens.
  void add(const DepthImage& depth, const ColorImage& color, const Camera& camera, const SE3& T_world_camera);

  /// The cloud of all images so far, with colours if there were any and with normals unless not wanted, in the order in
  /// which the voxels were met. Empty if there was no depth. InputError if a point is too far from the origin for
  /// single precision (round_point). May be called again after further add().
  PointCloud finish() const;

  std::size_t voxels() const { return grid_.cells().size(); }

 private:
  CloudOptions options_;
  VoxelGrid grid_;
  bool any_ = false;
  bool with_color_ = false;
};

}  // namespace odosplat
