// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A textured patch of an image, on the plane of a cloud's point that is seen there.
struct VisiblePatch {
  int x = 0;  // [px] its middle
  int y = 0;
  float inverse_depth = 0.0F;  // [1/m] of the plane at the middle, z along the optical axis
  float slope_u = 0.0F;        // [1/m/px]
  float slope_v = 0.0F;
  int index = 0;  // of the point in the cloud
};

/// 5 x 5 pixels, every other one of 9 x 9.
inline constexpr int patch_side = 5;
inline constexpr int patch_step = 2;
inline constexpr int patch_reach = patch_step * (patch_side / 2);

/// Patches around points of the cloud (with normals and spacings [m]) that no other point hides and that are textured
/// there (standard deviation of 3 grey levels of 255), at most `most`, evenly picked in the cloud's order; one a pixel.
std::vector<VisiblePatch> visible_patches(const PointCloud& cloud, const std::vector<float>& spacings,
                                          const GrayImage& image, const Camera& camera, const SE3& T_world_camera,
                                          int most);

/// 1 - the normalised cross correlation of the patch and of what the other image shows where the patch's plane is seen
/// from there: 0 for the same but brightness and contrast, about 1 for things of no relation, 2 at most. None if it is
/// not seen whole. Both images have the camera.
std::optional<double> patch_difference(const VisiblePatch& patch, const GrayImage& image, const GrayImage& other,
                                       const Camera& camera, const SE3& T_other_image);

/// Where the other image shows the patch.
struct PatchMatch {
  Eigen::Vector2d predicted;    // [px] where its plane is to be seen, and
  Eigen::Vector2d found;        // where it is
  Eigen::Matrix2d information;  // of `found`, of the gradients of normalised grey values
};

/// Looks for the patch around the place where it should be by shifting it (Lucas and Kanade 1981), brightness and
/// contrast left free. None if it leaves the image, is found more than most_shift [px] away, or the two correlate by
/// less than 0.8 there.
std::optional<PatchMatch> match_patch(const VisiblePatch& patch, const GrayImage& image, const GrayImage& other,
                                      const Camera& camera, const SE3& T_other_image, double most_shift);

}  // namespace odosplat
