// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/core/similarity.hpp"

namespace odosplat {

/// A value and its standard deviation.
struct Measured {
  double value = 0.0;
  double sigma = 0.0;
};

/// How a cloud would have to be moved, and the focal length changed, for the images to agree.
struct CloudFit {
  Similarity world_from_cloud;  // p_world = world_from_cloud * p_cloud
  Measured scale;               // of it, so that a cloud that is 5 % too large has 1 / 1.05
  Measured offset_m;            // [m] length of the shift of the middle of what is seen
  Measured origin_offset_m;     // [m] length of the shift of the world's origin: 0 if the cloud is only scaled about it
  Measured turn_deg;            // [deg] angle of its rotation
  Measured focal_px;            // [px] fx of the images handed in
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m] of the middle
  double median_depth_m = 0.0;                       // of the patches
  double error_before_px = 0.0;  // median distance, in one direction, of where patches are found from where they
  double error_after_px = 0.0;   // should be: as declared, and after the fit
  int patches = 0;
};

struct CloudFitInput {
  Camera camera;
  std::vector<std::size_t> images;               // numbers for gray()
  std::vector<SE3> T_world_camera;               // one an image, as they are to be used
  std::function<GrayImage(std::size_t)> gray;    // of the camera's size
  std::function<void(double)> progress;          // share that is done; may be empty
  const PointCloud* cloud = nullptr;             // with normals
  const std::vector<float>* spacings = nullptr;  // [m] one a point
};

struct CloudFitOptions {
  int gap = 16;       // between places in `images` of the pairs to begin with; up to four times as much at the end
  int pairs = 16;     // a gap
  int patches = 400;  // a pair
};

/// Points and normals under a similarity; other properties are left out.
PointCloud moved(const PointCloud& cloud, const Similarity& similarity);

/// Fits a similarity of the cloud about the middle of what is seen, and the focal length. Every patch (visible_patches)
/// is looked for in the pair's other image (match_patch); the distance from where it should be is linear in the eight
/// unknowns: the pixel stays, the plane under it moves. Weighted least squares on the directions in which a patch has
/// texture, Tukey's function against wrong matches, measured anew after every step. Sigmas: the larger one of the
/// formal one and of a jackknife over eight groups of neighbouring pairs, since errors of neighbours are alike. Weak
/// priors (half the median depth, 0.2 rad, 0.2 of the scales) keep open directions finite: a sigma near them means
/// that the data do not tell. No pair with enough patches: `patches` is 0.
CloudFit fit_cloud(const CloudFitInput& input, const CloudFitOptions& options);

}  // namespace odosplat
