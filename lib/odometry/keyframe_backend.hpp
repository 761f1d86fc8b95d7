// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/keyframe_maker.hpp"
#include "odosplat/odometry/reference_frame.hpp"
#include "odosplat/odometry/stage_times.hpp"
#include "odosplat/odometry/window.hpp"
#include "odosplat/odometry/window_optimizer.hpp"

namespace odosplat {

struct KeyframeBackendOptions {
  KeyframeMakerOptions keyframe;
  WindowOptions window;
  WindowOptimizerOptions optimizer;

  void check() const;
};

/// A tracked frame that should become a keyframe.
struct KeyframeRequest {
  const FramePyramid* pyramid = nullptr;
  int id = 0;         // the keyframe's number, if it is made
  int frame = 0;      // counts images from 0
  double time = 0.0;  // [s]
  SE3 T_world_camera;
  Brightness brightness;
};

/// What came of it.
struct KeyframeOutcome {
  bool made = false;  // false: the map shows too little there; the window is as it was
  bool anchored = false;
  double map_share = 0.0;              // share of the image where the map has depth
  std::vector<ReferenceFrame> window;  // all keyframes as they are now, oldest first
};

/// The odometry's back end: renders the map where a frame wants to become a keyframe, makes the keyframe, anchors it,
/// and adjusts the window of keyframes. Knows nothing of the frames between. Not thread safe; uses parallel_for inside.
class KeyframeBackend {
 public:
  /// map and tracker must outlive this.
  KeyframeBackend(const Camera& camera, MapView& map, const Tracker& tracker, const KeyframeBackendOptions& options);

  KeyframeOutcome add(const KeyframeRequest& request);

  const Window& window() const { return window_; }
  /// render, keyframe, optimise.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  std::vector<ReferenceFrame> references() const;

  Camera camera_;
  MapView& map_;
  const Tracker& tracker_;
  KeyframeBackendOptions options_;
  KeyframeMaker maker_;
  WindowOptimizer optimizer_;
  Window window_;
  std::vector<StageTime> stages_{{"render"}, {"keyframe"}, {"optimise"}};
};

}  // namespace odosplat
