// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/cloud/check/measured.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/core/similarity.hpp"

namespace odosplat {

/// The similarity by which a cloud, and the factor by which the focal length, would have to be corrected to agree with
/// the images.
struct CloudFit {
  Similarity world_from_cloud;  // p_world = world_from_cloud * p_cloud
  Measured scale;               // of world_from_cloud: 1 / 1.05 for a cloud that is 5 % too large
  Measured offset_m;            // [m] length of the shift at the middle of the visible part
  Measured origin_offset_m;     // [m] length of the shift of the world's origin: 0 if the cloud is only scaled about it
  Measured turn_deg;            // [deg] angle of its rotation
  Measured focal_px;            // [px] fx of the input images
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  // [m] the shift at that middle
  double median_depth_m = 0.0;                       // of the patches
  double error_before_px = 0.0;  // median distance along one direction between expected and found patch positions, as
  double error_after_px = 0.0;   // declared and after the fit
  int patches = 0;
};

struct CloudFitInput {
  Camera camera;
  std::vector<std::size_t> images;               // numbers for gray()
  std::vector<SE3> T_world_camera;               // one per image, after reading inverted or reflected poses
  std::function<GrayImage(std::size_t)> gray;    // of the camera's size
  std::function<void(double)> progress;          // called with the share of the work done; may be empty
  const PointCloud* cloud = nullptr;             // with normals
  const std::vector<float>* spacings = nullptr;  // [m] one per point
};

struct CloudFitOptions {
  int gap = 16;       // index difference in `images` of the first pairs; up to four times as much at the end
  int pairs = 16;     // per gap
  int patches = 400;  // per pair
};

/// Points and normals transformed by a similarity; other properties are left out.
PointCloud moved(const PointCloud& cloud, const Similarity& similarity);

/// Fits a similarity of the cloud about the middle of the visible part, and the focal length. Every patch
/// (visible_patches) is searched in the pair's other image (match_patch). The distance between its expected and found
/// position is linearised in the eight unknowns: the patch's pixel is fixed, and the plane behind it moves. Solved by
/// weighted least squares over the directions in which a patch has texture, with Tukey's function against wrong
/// matches; patches are matched again after every step.
/// Sigmas: the larger of the formal one and that of a jackknife over eight groups of neighbouring pairs (whose errors
/// are correlated), plus a floor for errors of poses, shutter and lens. Weak priors (half the median depth, 0.2 rad,
/// 0.2 of the scales) keep directions finite that the data do not determine; a sigma close to them indicates such a
/// direction. `patches` is 0 if no pair has enough patches.
CloudFit fit_cloud(const CloudFitInput& input, const CloudFitOptions& options);

}  // namespace odosplat
