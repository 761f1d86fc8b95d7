// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/cloud/check/cloud_fit.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/pair_scores.hpp"
#include "odosplat/core/point_cloud.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// Posed images with the conventions that their files declare, and a cloud of the place.
struct CloudCheckInput {
  Camera camera;    // fy > 0; the declared sign is fy_sign
  int fy_sign = 1;  // +1 or -1
  // One per image, as stored in the files: neither inverted nor reflected. None: the files have no pose for the image.
  std::vector<std::optional<SE3>> T_world_camera;
  // Grey image of the camera's size; called from one thread, and repeatedly for some images.
  std::function<GrayImage(std::size_t)> gray;
  // Called from time to time with the share of the work done; may be empty. The share decreases if more work becomes
  // necessary than was expected.
  std::function<void(double)> progress;
  PointCloud cloud;  // [m] in the world frame of the poses after these are reflected for a negative fy
};

struct CloudCheckOptions {
  int gap = 32;              // [frames] between the two images of a pair; shorter if images hardly overlap
  int pairs = 16;            // pairs of images, spread evenly
  int max_shift = 3;         // [frames] largest shift of the ids that is tried, in both directions
  int patches = 800;         // per pair
  double min_overlap = 0.2;  // share of them that must be visible in the other image
  double max_error = 0.5;    // largest error of a reading that is accepted
  int most_points = 60000;   // of the cloud that are used; larger clouds are thinned
  int largest_width = 400;   // [px] images are halved until they are no wider
  // The smallest deviations that are reported as errors: of the cloud's scale from 1; of the offset as a share of the
  // median depth, and of the rotation [rad], which shifts points by the same amount; of the focal length, relative.
  double least_scale = 0.01;
  double least_offset = 0.015;
  double least_focal = 0.02;
  double sure = 4.0;  // [standard deviations] that a deviation must exceed to be reported

  void check() const;
};

/// One interpretation of the data.
struct CloudReading {
  int fy_sign = 1;
  bool mirrored = false;  // the cloud's y must be negated, as the poses are for a negative fy
  bool inverted = false;  // the stored poses are T_camera_world
  int id_shift = 0;       // image k belongs to the pose stored for image k + id_shift
  bool operator==(const CloudReading&) const = default;
};

/// A row of the table. Its errors are medians of 1 - normalised cross correlation: 0 if the images agree, about 1 if
/// they are unrelated.
struct CloudRow : PairScores {
  CloudReading reading;
  double overlap = 0.0;  // mean share of the patches that are visible in the other image
};

/// Tests whether patches agree because of the cloud's shape. The cloud is compared with two controls that replace it:
/// `flat` has all patches of an image at one distance and facing the camera, `distant` has all patches so far away that
/// the camera's motion does not shift them. A cloud that fits beats both; a cloud of another place, a rotated one, or
/// one in another unit is no better than a flat wall.
struct CloudControl {
  PairScores cloud;
  PairScores flat;
  PairScores distant;
};

/// The result for one part of the data.
struct CloudFinding {
  std::string part;           // "cloud unit", "fy", "cloud's y", "poses", "id shift", "cloud scale", "cloud offset",
                              // "cloud rotation", "focal length"
  std::optional<bool> right;  // whether it is as declared; none: not decidable from the data
  std::string text;           // one sentence; empty if right
};

/// agree: the cloud is shown to fit, no part is found to differ, and its scale and offset are measured precisely
/// enough. differ: a part is found to differ, or the cloud fits under no reading. undecided: the images do not decide
/// it.
enum class CloudAnswer { agree, differ, undecided };

struct CloudCheckReport {
  std::vector<CloudRow> rows;  // best first, with the cloud converted by `unit`
  double unit = 1.0;           // factor by which the cloud's coordinates are too large in the unit of the poses
  CloudReading declared;
  CloudReading winner;
  int gap = 0;
  int pairs = 0;
  bool believable = false;                // the winner's error is below max_error
  bool textured = false;                  // enough of the cloud's visible points lie on texture
  std::optional<CloudFit> fit;            // of scale, offset, rotation and focal length; if believable and measurable
  CloudControl given;                     // of the winner, on the pairs of the rows
  std::optional<CloudControl> corrected;  // the same with the fit applied; if there is a fit
  double largest_gap_error = 0.0;         // error of the best row at the largest gap tried; infinite: no overlap
  std::vector<CloudFinding> findings;
  CloudAnswer answer = CloudAnswer::undecided;
  std::string verdict;  // one line

  /// The cloud as given beats both controls, and the fit does not move it beyond the range of valid fits.
  bool fits() const;
  /// The fit is within the range of valid fits, and with it patches agree better than as given and better than with
  /// both controls.
  bool correction_gains() const;
};

}  // namespace odosplat
