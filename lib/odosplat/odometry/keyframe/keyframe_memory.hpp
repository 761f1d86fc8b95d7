// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <vector>

#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/keyframe/keyframe.hpp"

namespace odosplat {

/// Values were chosen by the number of frames until the camera is within 5 mm again when it returns (docs/rules.md).
struct KeyframeMemoryOptions {
  bool enabled = true;
  double map_share = 0.9;         // share of the image with map depth below which remembered keyframes are used
  int max_links = 1;              // keyframes of more links to the map are not kept
  double likeness = 0.3;          // least likeness of a keyframe that is tried
  double known = 0.92;            // likeness to a kept keyframe from which on a new one is not kept, as it adds nothing
  double parallax = 0.3;          // [rad] between a point's rays in both images at which it counts 1/e towards likeness
  int views = 3;                  // most keyframes that one image is aligned with: each is wrong by some millimetres
                                  // over 50 frames
  double strength = 2.0;          // sum of their weights in the window; shared out by squared likeness
  double min_inliers = 0.6;       // of the alignment with a remembered keyframe
  double min_correlation = 0.98;  // the same
  double max_rmse = 8.0 / 255;    // [grey] the same
  int capacity = 400;             // keyframes, of 0.3 MB at 320x240; the one not asked for longest goes first

  void check() const;
};

/// A remembered keyframe found in an image.
struct Recollection {
  Anchor anchor;       // the keyframe as it was made, its pose and depth taken as known
  SE3 T_world_camera;  // pose of the image's camera, by alignment with the keyframe
  double flow = 0.0;  // [px] root mean square motion of its points in the image from where the camera was thought to be
  int links = 0;      // between it and the map
};

/// Keyframes that were aligned with the map, kept for places where the map shows little. At its border a map is least
/// accurate, and a real image taken there, with the depth that its window gave it, determines a pose better. A camera
/// that leaves the map is aligned with the last of these keyframes, and with the same ones when it returns. Not thread
/// safe.
class KeyframeMemory {
 public:
  KeyframeMemory(const Camera& camera, const KeyframeMemoryOptions& options);

  /// Keeps a keyframe that has its reference, unless a kept one shows the same. links: 0 if it was aligned with the map
  /// in full view; else one more than the fewest of the recollections that it was aligned with.
  void remember(std::shared_ptr<const Keyframe> keyframe, int links);
  /// Removes a keyframe whose pose has turned out to be wrong.
  void forget(const Keyframe& keyframe);
  /// Kept keyframes that are found in the image of a camera near T_world_camera [m], the likest first; none if none is.
  std::vector<Recollection> recall(const FramePyramid& image, const SE3& T_world_camera, const ImageAligner& aligner);

  std::size_t size() const { return kept_.size(); }
  const KeyframeMemoryOptions& options() const { return options_; }

 private:
  struct Kept {
    std::shared_ptr<const Keyframe> keyframe;
    int links = 0;
    int last_use = 0;
  };
  /// Share of the keyframe's points that a camera there sees; each counts less the more its ray has turned.
  double likeness(const Keyframe& keyframe, const SE3& T_world_camera) const;

  Camera camera_;
  KeyframeMemoryOptions options_;
  std::vector<Kept> kept_;
  int uses_ = 0;
};

}  // namespace odosplat
