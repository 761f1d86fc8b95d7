// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/keyframe.hpp"
#include "odosplat/odometry/tracker.hpp"
#include "odosplat/odometry/window_points.hpp"

namespace odosplat {

struct AnchorOptions {
  bool enabled = true;
  double noise = 5.0 / 255;  // [grey] residual of a rendered view at which it counts like a real image
  double strength = 4.0;     // factor of its weight: one rendered view stands against six keyframes
  // Share of its points that must agree with the real image. The coarse map of a real room (20 dB) reaches 0.4 to 0.6
  // and still holds the camera: with 0.6 it drifted by 7 cm (7-Scenes redkitchen), with 0.4 by 2.4.
  double min_inliers = 0.4;
  double min_coverage = 0.3;       // share of its points that must be in view
  double max_rmse = 12.0 / 255;    // [grey]
  double render_again_flow = 2.0;  // [px] a keyframe that the map moves further is rendered from its new place
  double reset_flow = 4.0;         // [px] beyond, the rest of the window is believed to be wrong and is dropped

  void check() const;
};

struct KeyframeMakerOptions {
  SelectorOptions selector;
  ReferenceOptions reference;
  MapPlaneOptions plane;
  WindowPointOptions window_points;
  AnchorOptions anchor;
  double smoothing = 0.8;  // [px] of all images before use, real and rendered; 0: none
  int min_points = 100;    // with map depth, on full size; fewer make no keyframe

  void check() const;
};

/// What came of the attempt to make a keyframe.
struct MadeKeyframe {
  std::shared_ptr<Keyframe> keyframe;  // null: the map shows too little there
  double map_share = 0.0;              // share of the image with map depth
  bool anchored = false;
  Alignment anchor;        // of the keyframe's image against the rendered one
  SE3 T_world_camera_map;  // where that alignment puts the camera, if anchored
  double map_flow = 0.0;   // [px] root mean square image motion between that and the pose rendered from
};

/// Turns an image and the map's view from its pose into a keyframe: points with map depth for tracking and for the
/// window, and the rendered view itself as anchor where it resembles the image. Holds scratch memory; not thread safe.
class KeyframeMaker {
 public:
  explicit KeyframeMaker(const KeyframeMakerOptions& options);

  /// view must have been rendered with the pyramid's camera from T_world_camera. The keyframe's pose and brightness are
  /// as given; id, frame and time are left to the caller. tracker aligns image and rendered view.
  MadeKeyframe make(const FramePyramid& pyramid, const ViewImages& view, const SE3& T_world_camera,
                    const Brightness& brightness, const Tracker& tracker);

  const KeyframeMakerOptions& options() const { return options_; }

 private:
  void add_anchor(MadeKeyframe& made, const FramePyramid& pyramid, const ViewImages& view, const Tracker& tracker);

  KeyframeMakerOptions options_;
  PixelSelector reference_selector_;
  PixelSelector window_selector_;
  PixelSelector map_reference_selector_;
  PixelSelector anchor_selector_;
};

}  // namespace odosplat
