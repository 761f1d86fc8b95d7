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
  double voxel = 0.03;           // [m] edge of a voxel; one point per voxel is kept
  double noise = 0.0;            // [m] standard deviation of the range noise added to each final point
  std::uint64_t seed = 0;        // of the noise
  double min_depth = 0.1;        // [m] nearer depths are not used
  double max_depth = 20.0;       // [m] farther depths are not used
  double max_depth_step = 0.03;  // largest share of a pixel's depth by which a neighbour may be nearer
  double max_incidence = 80.0;   // [deg] largest angle between the viewing ray and the surface's normal
  int normal_neighbors = 16;     // neighbours to which a normal is fitted; 0: no normals

  void check() const;
};

/// Makes a point cloud from posed depth images, similar to that of a laser scanner: the input of the trainer and of the
/// interpolation view.
///
/// Every pixel with depth in range becomes a point in the world, and the points of a voxel are replaced by their mean.
/// Left out are pixels with a nearer neighbour (on the far side of an occluding edge, where sensors mix the depths and
/// colours of both sides; the near side is kept, so that thin objects remain) and pixels seen at a grazing angle.
///
/// Noise: the mean over a voxel would average out noise added to each pixel, so it is added to the final points: each
/// is moved along the mean of its viewing rays by a normally distributed distance with standard deviation `noise`, like
/// the range error of a scanner that measures once per voxel. Normals are fitted afterwards, to the noisy points, and
/// face the cameras.
///
/// Memory is proportional to the number of voxels, not of images. Deterministic; not thread safe.
class CloudBuilder {
 public:
  explicit CloudBuilder(const CloudOptions& options);

  /// depth [m], of the camera's size; color of the same size, or empty for all images. Throws InputError for other
  /// sizes, an invalid camera, a pose that is not finite, or colour in only some of the images. An image without depth
  /// adds nothing.
  void add(const DepthImage& depth, const ColorImage& color, const Camera& camera, const SE3& T_world_camera);

  /// The cloud of all images so far, with colours if the images have them and with normals unless normal_neighbors is
  /// 0, in the order in which the voxels got their first point. Empty if there was no depth. Throws InputError if a
  /// point is too far from the origin for single precision (round_point). May be called again after further add().
  PointCloud finish() const;

  std::size_t voxels() const { return grid_.cells().size(); }

 private:
  CloudOptions options_;
  VoxelGrid grid_;
  bool any_ = false;
  bool with_color_ = false;
};

}  // namespace odosplat
