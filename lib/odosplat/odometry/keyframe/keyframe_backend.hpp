// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/confirm/camera_misfit.hpp"
#include "odosplat/odometry/confirm/rendered_view.hpp"
#include "odosplat/odometry/frame/reference_frame.hpp"
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"
#include "odosplat/odometry/keyframe/keyframe_memory.hpp"
#include "odosplat/odometry/stage_times.hpp"
#include "odosplat/odometry/window/marginalization.hpp"
#include "odosplat/odometry/window/point_activation.hpp"
#include "odosplat/odometry/window/window.hpp"
#include "odosplat/odometry/window/window_optimizer.hpp"

namespace odosplat {

/// What one keyframe outside the map adds to the uncertainty of its place: a window takes its oldest keyframe for
/// known, and so knows nothing of drift. Standard deviations, as OdometryOptions::keyframe_covariance_factor finds
/// them.
struct DriftOptions {
  double translation = 0.001;  // [m] along each axis
  double rotation = 0.0005;    // [rad] about each

  void check() const;
};

/// Covariance of exp(xi) on the left of T_world_camera that one keyframe adds.
Matrix6d drift_covariance(const DriftOptions& options, const SE3& T_world_camera);

struct KeyframeBackendOptions {
  KeyframeMakerOptions keyframe;
  ConfirmationOptions confirmation;
  CameraMisfitOptions misfit;
  KeyframeMemoryOptions memory;
  WindowOptions window;
  WindowOptimizerOptions optimizer;
  MarginalizationOptions marginalization;
  ActivationOptions activation;
  DriftOptions drift;

  void check() const;
};

/// A frame that was tracked.
struct TrackedImage {
  std::shared_ptr<const FramePyramid> pyramid;
  SE3 T_world_camera;
  Brightness brightness;
};

/// A tracked frame that should become a keyframe.
struct KeyframeRequest {
  EvenFrame image;
  std::shared_ptr<MapView> view;  // to look at in the map's place, as with a depth sensor; null: the map
  int id = 0;                     // the keyframe's number, if it is made
  int frame = 0;                  // counts images from 0
  double time = 0.0;              // [s]
  SE3 T_world_camera;
  Brightness brightness;
  bool fresh = false;  // the keyframes that stand are not to be trusted: the window starts anew with this one
};

/// What came of it.
struct KeyframeOutcome {
  bool made = false;         // false: too little depth there; the window is as it was
  bool anchored = false;     // held by the map's colours, or by keyframes that these held before
  bool prefetched = false;   // made from the view that was rendered ahead
  bool in_map = false;       // the map alone gives depth enough; else the camera goes by what it has seen on its way
  double map_share = 0.0;    // share of the image where the map has depth
  MapEvidence evidence;      // of the image and the map at the keyframe's pose
  MisfitEffect misfit;       // of what is wrong with the camera on the keyframe's pose
  std::string likely_cause;  // what that is; empty: nothing that stands out
  std::vector<ReferenceFrame> window;  // all keyframes as they are now, oldest first
};

/// The odometry's back end: renders the map where a frame wants to become a keyframe, makes the keyframe, anchors it,
/// and adjusts the window of keyframes. Pixels that the map does not show become points by motion: every frame between
/// narrows their depth (trace), and keyframes outside the map live on these alone. Where the map shows little,
/// keyframes made before hold the camera, if they are found (KeyframeMemory). Once the camera has been outside, the
/// map's depth is believed again from the first keyframe on that its colours, or these, hold in place; the keyframes
/// made outside are moved along then. Not thread safe; uses parallel_for inside.
class KeyframeBackend {
 public:
  /// map and aligner must outlive this.
  KeyframeBackend(const Camera& camera, MapView& map, const ImageAligner& aligner,
                  const KeyframeBackendOptions& options);

  KeyframeOutcome add(const KeyframeRequest& request);

  /// Renders the map where the next keyframe will probably be. The next keyframe is made from this view if its frame
  /// lies within render_again_flow of it: no farther off than an anchored keyframe may lie from the view rendered for
  /// it.
  void prefetch(const SE3& T_world_camera);
  /// A tracked frame, keyframe or not; before add, if it is to become one. Costs nothing where the map shows
  /// everything.
  void trace(const TrackedImage& image);

  const Window& window() const { return window_; }
  /// render, keyframe, optimise, trace, confirm.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  RenderedView seen_from(MapView& map, const SE3& T_world_camera);
  /// A keyframe as it was made last, of several renderings maybe.
  struct Attempt {
    MadeKeyframe made;
    double corrected = 0.0;                      // [px] farthest that the map has moved it from where it was tracked
    bool prefetched = false;                     // made from the view that was rendered ahead
    std::optional<int> links;                    // to the map, if the keyframe is fit to be remembered
    std::shared_ptr<const ViewPatches> patches;  // of the view that it was made from
  };
  /// What poses near the view are confirmed by; null where the view has no colours or nothing is to be confirmed.
  std::shared_ptr<const ViewPatches> patches_of(const RenderedView& view);
  /// The keyframe as this view gives it. Makes image and gradients even where the map shows that they are not.
  MadeKeyframe make_from(const RenderedView& view, const KeyframeRequest& request, const KeyframeContext& context,
                         EvenFrame& image, std::vector<GradientImage>& gradients);
  std::vector<Recollection> recall(const FramePyramid& image, const SE3& T_world_camera);
  /// A keyframe where remembered ones, at least one, put it. view: from there.
  Attempt make_recalled(const RenderedView& view, std::vector<Recollection> recalled, const KeyframeRequest& request,
                        KeyframeContext context, EvenFrame& image, std::vector<GradientImage>& gradients);
  /// Makes image and gradients even where the map shows that they are not.
  Attempt make(const KeyframeRequest& request, EvenFrame& image, std::vector<GradientImage>& gradients);
  void make_room();
  /// Moves the keyframes that only their own motion has placed; far: what the map holds is elsewhere, and is dropped.
  void come_back(const SE3& T_correction, bool far);
  std::vector<TransferredPoint> points_seen_from(const SE3& T_world_camera) const;
  std::vector<ReferenceFrame> references() const;
  /// Of a keyframe's place: what its window says, and drift.
  Matrix6d covariance(const Keyframe& keyframe) const;

  Camera camera_;
  MapView& map_;
  const ImageAligner& aligner_;
  KeyframeBackendOptions options_;
  KeyframeMaker maker_;
  WindowOptimizer optimizer_;
  CameraMisfit misfit_;
  KeyframeMemory memory_;
  Window window_;
  std::optional<RenderedView> prefetched_;
  bool outside_ = false;  // the map has been left and has not been found again
  std::vector<StageTime> stages_{{"render"}, {"keyframe"}, {"optimise"}, {"trace"}, {"confirm"}};
};

}  // namespace odosplat
