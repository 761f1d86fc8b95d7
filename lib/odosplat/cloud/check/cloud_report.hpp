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

/// Posed images with what their files say about them, and a cloud of the place.
struct CloudCheckInput {
  Camera camera;    // fy > 0; its sign as declared is fy_sign
  int fy_sign = 1;  // +1 or -1
  // One an image, as the files have them: neither inverted nor reflected. None: the files have no pose for it.
  std::vector<std::optional<SE3>> T_world_camera;
  // Grey image of the camera's size; called from one thread, for a few images again and again.
  std::function<GrayImage(std::size_t)> gray;
  // Called now and then with the share of the work that is done; may be empty. The share falls if more has to be done
  // than was foreseen.
  std::function<void(double)> progress;
  PointCloud cloud;  // [m] in the world that the poses are meant for once they are reflected for a negative fy
};

struct CloudCheckOptions {
  int gap = 32;              // [frames] between the two images of a pair, less where images hardly overlap
  int pairs = 16;            // pairs of images, spread evenly
  int max_shift = 3;         // [frames] shifts of the ids that are tried, either way
  int patches = 800;         // looked at a pair
  double min_overlap = 0.2;  // share of them that must be seen in the other image
  double max_error = 0.5;    // largest error of a reading that is believed
  int most_points = 60000;   // of the cloud that are used; more are thinned
  int largest_width = 400;   // [px] images are halved until they are no wider
  // What is called wrong: the cloud's scale (less 1), an offset as a share of the median depth or a turn [rad] that
  // moves things by as much, and the focal length as a share of it.
  double least_scale = 0.01;
  double least_offset = 0.015;
  double least_focal = 0.02;
  double sure = 4.0;  // standard deviations

  void check() const;
};

/// One way to read the data.
struct CloudReading {
  int fy_sign = 1;
  bool mirrored = false;  // the cloud's y must be negated, as the poses are for a negative fy
  bool inverted = false;  // the stored poses are T_camera_world
  int id_shift = 0;       // image k belongs to the pose stored for image k + id_shift
  bool operator==(const CloudReading&) const = default;
};

/// A row of the table. Its errors are medians of 1 - normalised cross correlation: 0 where the images agree, about 1
/// where they have nothing in common.
struct CloudRow : PairScores {
  CloudReading reading;
  double overlap = 0.0;  // mean share of the patches that the other image shows
};

/// Whether the shape of the cloud is what makes patches agree. Two controls take its place: all patches of an image at
/// one distance and facing the camera, and all too far off for any motion to show. A cloud that fits beats both; one of
/// another place, turned, or in another unit does no better than a flat wall would.
struct CloudControl {
  PairScores cloud;
  PairScores flat;
  PairScores distant;
};

/// What is said of one part.
struct CloudFinding {
  std::string part;           // "cloud unit", "fy", "cloud's y", "poses", "id shift", "cloud scale", "cloud offset",
                              // "cloud rotation", "focal length"
  std::optional<bool> right;  // as declared; none: the data do not tell
  std::string text;           // one sentence; empty if right
};

/// agree: the cloud is shown to fit, nothing is found to differ, and its scale and place are measured well enough to
/// say so. differ: a part is found to differ, or the cloud fits under no reading. undecided: the images do not tell.
enum class CloudAnswer { agree, differ, undecided };

struct CloudCheckReport {
  std::vector<CloudRow> rows;  // best first, with the cloud in the unit that was found
  double unit = 1.0;           // the cloud's coordinates are this many times the poses' unit too large
  CloudReading declared;
  CloudReading winner;
  int gap = 0;
  int pairs = 0;
  bool believable = false;                // the winner's error is below max_error
  bool textured = false;                  // enough of the cloud's visible points lie on texture
  std::optional<CloudFit> fit;            // of scale, offset, rotation and focal length; if believable and measurable
  CloudControl given;                     // of the winner, on the pairs of the rows
  std::optional<CloudControl> corrected;  // with what was fitted; if there is a fit
  double largest_gap_error = 0.0;         // the winner's at the largest gap that was looked at; infinite: no overlap
  std::vector<CloudFinding> findings;
  CloudAnswer answer = CloudAnswer::undecided;
  std::string verdict;  // one line

  /// The cloud as given does better than both controls, and the fit does not want it elsewhere altogether.
  bool fits() const;
  /// What was fitted is within what a fit from there can find, makes patches agree better than they do as given, and
  /// better than both controls do with it.
  bool correction_gains() const;
};

}  // namespace odosplat
