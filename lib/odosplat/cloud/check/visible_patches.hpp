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

/// A textured patch of an image, on the plane around a cloud point that is visible there.
struct VisiblePatch {
  int x = 0;  // [px] its centre
  int y = 0;
  float inverse_depth = 0.0F;  // [1/m] of the plane at the centre, z along the optical axis
  float slope_u = 0.0F;        // [1/m/px]
  float slope_v = 0.0F;
  int index = 0;  // of the point in the cloud
};

/// 5 x 5 pixels: every second pixel of 9 x 9.
inline constexpr int visible_patch_side = 5;
inline constexpr int patch_step = 2;
inline constexpr int patch_reach = patch_step * (visible_patch_side / 2);

/// Patches around points of the cloud (with normals and spacings [m]) that are not occluded and have texture (standard
/// deviation of at least 3 grey levels of 255); at most `most`, picked evenly in the cloud's order, and one per pixel.
std::vector<VisiblePatch> visible_patches(const PointCloud& cloud, const std::vector<float>& spacings,
                                          const GrayImage& image, const Camera& camera, const SE3& T_world_camera,
                                          int most);

/// 1 - the normalised cross correlation of the patch and the other image at the patch's projection: 0 if the two are
/// equal up to brightness and contrast, about 1 if they are unrelated, 2 at most. None if the patch is not completely
/// inside the other image. Both images have the same camera.
std::optional<double> patch_difference(const VisiblePatch& patch, const GrayImage& image, const GrayImage& other,
                                       const Camera& camera, const SE3& T_other_image);

/// The position of a patch in the other image.
struct PatchMatch {
  Eigen::Vector2d predicted;    // [px] projection of its centre
  Eigen::Vector2d found;        // [px] position found
  Eigen::Matrix2d information;  // of `found`, from the gradients of normalised grey values
};

/// Searches the patch around `search_from` (by default its projection) by shifting it (Lucas and Kanade 1981), independent of brightness
/// and contrast. None if it leaves the image, is found more than most_shift [px] from there, or has a correlation of less
/// than 0.8 there.
std::optional<PatchMatch> match_patch(const VisiblePatch& patch, const GrayImage& image, const GrayImage& other,
                                      const Camera& camera, const SE3& T_other_image, double most_shift,
                                      const std::optional<Eigen::Vector2d>& search_from = std::nullopt);

}  // namespace odosplat
