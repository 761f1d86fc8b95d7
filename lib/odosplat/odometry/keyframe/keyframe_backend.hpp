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
#include "odosplat/odometry/frame/posed_frame.hpp"
#include "odosplat/odometry/frame/reference_frame.hpp"
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"
#include "odosplat/odometry/keyframe/keyframe_memory.hpp"
#include "odosplat/odometry/stage_times.hpp"
#include "odosplat/odometry/window/marginalization.hpp"
#include "odosplat/odometry/window/point_activation.hpp"
#include "odosplat/odometry/window/window.hpp"
#include "odosplat/odometry/window/window_optimizer.hpp"

namespace odosplat {

/// What one keyframe outside the map adds to the uncertainty of its pose: a window takes its oldest keyframe as known,
/// so that its covariance contains no drift. Standard deviations, before the covariance is multiplied by
/// OdometryOptions::keyframe_covariance_factor.
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
  MisfitLimits max_misfit;  // of keyframes that are to be confirmed

  void check() const;
};

/// A tracked frame that should become a keyframe.
struct KeyframeRequest {
  PosedFrame frame;
  std::shared_ptr<MapView> view;  // rendered in place of the map, for example a depth sensor; null: the map
  int id = 0;                     // the keyframe's number, if it is made
  bool to_be_confirmed = false;   // made only if the map's colours, where it has any, confirm the pose, and if no
                                  // likely error of the camera (MisfitEffect) has moved it too far
  bool fresh = false;             // the existing keyframes are not to be trusted: the window starts anew with this one
};

/// The result of a KeyframeRequest.
struct KeyframeOutcome {
  bool made = false;                   // false: too little depth there, or not confirmed; the window is as it was
  bool anchored = false;               // aligned with the map's colours, or with remembered keyframes that were
  bool prefetched = false;             // made from the view that was rendered ahead
  bool in_map = false;                 // the map alone gives enough depth; false: depth is found by motion
  double map_share = 0.0;              // share of the image where the map has depth
  MapEvidence evidence;                // of the image and the map at the keyframe's pose
  MisfitEffect misfit;                 // effect of errors of the camera's calibration on the keyframe's pose
  std::string likely_cause;            // what is probably wrong with the camera; empty: nothing significant
  std::vector<ReferenceFrame> window;  // all keyframes as they are now, oldest first
};

/// The odometry's back end: renders the map where a frame is to become a keyframe, makes the keyframe, aligns it with
/// the map (Anchor), and adjusts the window of keyframes. Pixels that the map does not show become points whose depth
/// is found by motion: every tracked frame narrows it (trace), and keyframes outside the map have only such points.
/// Where the map shows little, a keyframe is aligned with remembered keyframes, if these are found in its image
/// (KeyframeMemory). Once the camera has been outside, the map's depth is used again from the first keyframe on that is
/// aligned with the map's colours or with remembered keyframes; the keyframes made outside are corrected along with it.
/// Not thread safe; uses parallel_for inside.
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
  /// Narrows the depth of immature points by a tracked frame. For a frame that is to become a keyframe, call it before
  /// add. Costs nothing where the map shows everything.
  void trace(const PosedFrame& frame);

  const Window& window() const { return window_; }
  /// render, keyframe, optimise, trace, confirm.
  const std::vector<StageTime>& stages() const { return stages_; }

 private:
  RenderedView seen_from(MapView& map, const SE3& T_world_camera);
  /// The latest attempt to make a keyframe; it may render the map several times.
  struct Attempt {
    MadeKeyframe made;
    double corrected = 0.0;                      // [px] largest image motion by which the map has corrected the tracked
                                                 // pose
    bool prefetched = false;                     // made from the view that was rendered ahead
    std::optional<int> links;                    // number of links to the map (KeyframeMemory), if the keyframe may be
                                                 // remembered
    std::shared_ptr<const ViewPatches> patches;  // of the view that it was made from
  };
  /// Patches by which poses near the view are confirmed; null where the view has no colours or confirmation is off.
  std::shared_ptr<const ViewPatches> patches_of(const RenderedView& view);
  /// Makes a keyframe from this view, whose grey values are computed if they are not yet. Removes the row gain from image
  /// and gradients if the view shows that there is one.
  MadeKeyframe make_from(RenderedView& view, const KeyframeRequest& request, const KeyframeContext& context,
                         EvenFrame& image, std::vector<GradientImage>& gradients);
  std::vector<Recollection> recall(const FramePyramid& image, const SE3& T_world_camera);
  /// Makes a keyframe at the pose found by remembered keyframes, of which there is at least one. view: rendered from
  /// there.
  Attempt make_recalled(RenderedView& view, std::vector<Recollection> recalled, const KeyframeRequest& request,
                        KeyframeContext context, EvenFrame& image, std::vector<GradientImage>& gradients);
  /// Removes the row gain from image and gradients as make_from does.
  Attempt make(const KeyframeRequest& request, EvenFrame& image, std::vector<GradientImage>& gradients);
  void make_room();
  /// Corrects the keyframes that were placed by motion alone. far: those that the map placed are at a wrong place, and
  /// are dropped.
  void come_back(const SE3& T_correction, bool far);
  std::vector<TransferredPoint> points_seen_from(const SE3& T_world_camera) const;
  std::vector<ReferenceFrame> references() const;
  /// Covariance of a keyframe's pose: the window's, plus drift.
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
