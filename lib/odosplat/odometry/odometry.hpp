// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/frame/frame_tracker.hpp"
#include "odosplat/odometry/keyframe/keyframe_backend.hpp"
#include "odosplat/odometry/keyframe/keyframe_worker.hpp"
#include "odosplat/odometry/trajectory_record.hpp"

namespace odosplat {

class Relocalizer;

struct OdometryOptions {
  ImageAlignerOptions aligner;
  KeyframeMakerOptions keyframe;
  ConfirmationOptions confirmation;
  CameraMisfitOptions misfit;
  KeyframeMemoryOptions memory;
  KeyframePolicyOptions policy;
  WindowOptions window;
  WindowOptimizerOptions optimizer;
  MarginalizationOptions marginalization;
  ActivationOptions activation;
  DriftOptions drift;
  AcceptOptions accept;
  /// Neighbouring pixels err alike, and a map's colours are off by parts of a pixel for a whole view; normal equations
  /// know nothing of either. A frame's covariance is that of its alignment with its keyframe times the first, plus its
  /// keyframe's in the window times the second. docs/rules.md has the mean normalised error squared, of which 6 is
  /// right.
  double frame_covariance_factor = 1.0;
  double keyframe_covariance_factor = 40.0;
  /// Real time: keyframes are made on a thread of their own, while track() goes on with the keyframes that stand.
  /// Which frame sees which keyframe then depends on the clock. false: track() makes them itself; same input, same
  /// bits.
  bool background = false;
  /// background: the map is rendered ahead, at the pose where the next keyframe is expected, this many images before.
  /// Two images ahead constant velocity is mostly right to 2 px, three ahead less often (docs/rules.md).
  double prefetch_images = 2.0;
  /// Frames about which the map says nothing, beyond which a pose no longer counts as one in the map.
  int max_unconfirmed = 10;
  /// A pose is refused where a wrong camera seems to have moved it by more than this: from there on, what is estimated
  /// of the camera is itself too rough to stand in a covariance.
  double max_misfit_translation = 0.05;  // [m]
  double max_misfit_rotation = 0.04;     // [rad]

  void check() const;
};

/// ok: tracked on from the last images. relocalised: found without them, after a loss or at a start whose pose is not
/// known or wrong.
enum class TrackStatus { ok, lost, relocalised };
/// "ok", "lost", "relocalised".
std::string to_string(TrackStatus status);

/// What became of one image. T_world_camera is the pose as known now; Odometry::trajectory() has the final one.
struct TrackResult {
  TrackStatus status = TrackStatus::lost;
  SE3 T_world_camera;                      // identity when lost: no pose is made up
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera; zero when lost
  bool keyframe = false;      // became a keyframe; with options.background that comes later: see keyframe_times()
  double inlier_share = 0.0;  // of the points in view
  double coverage = 0.0;      // share of the reference keyframe's points in view
  double rmse = 0.0;          // [grey] of the inliers
  double correlation = 0.0;   // of the image with the reference keyframe at its points, -1..1
  double map_share = 0.0;     // share of the image where the map has depth, of the last that was tried as keyframe
  /// What the map says about the pose; Confirmation::none where it was not asked, as in maps without colours.
  MapEvidence evidence;
  /// The last keyframe has its depth from the map, and the map has confirmed this pose, or says nothing about it and
  /// has confirmed one of the options.max_unconfirmed before (a map without colours is believed as it is). false: plain
  /// odometry.
  bool in_map = false;
  bool anchored = false;  // a keyframe that the map's colours hold in place, or keyframes that these held before
  double misfit = 0.0;  // [m] how far a camera that is not quite right seems to have moved the pose; in its covariance
  double milliseconds = 0.0;
};

/// Sums over all images so far.
struct OdometryStatistics {
  std::vector<StageTime> stages;  // pyramid, track, relocalise, render, keyframe, optimise, trace
  int frames = 0;
  int posed = 0;
  int lost = 0;
  int relocalisations = 0;
  int keyframes = 0;
  int anchored = 0;
  int prefetched = 0;        // keyframes made from a view that was rendered ahead
  int confirmed = 0;         // posed frames that the map has confirmed
  std::string likely_cause;  // what is wrong with the camera, by its keyframes; empty: nothing that stands out
  int refused = 0;  // frames that were tracked but that the map spoke against, or did not confirm where it had to
};

/// Direct sparse odometry in a prior map: every image gets its pose in the map's frame.
/// Source: the paper's local odometry (direct tracking against the last keyframe, sliding window of keyframes, depth of
/// keyframe points rendered from the map); Engel et al. 2018 (DSO) for selection, residuals and keyframe rule. Differs:
/// points keep to the map's planes when their keyframe moves, and every keyframe is also aligned with the map's
/// rendered image, which removes drift; no intrinsics are estimated; no null space is projected out. Where the map
/// shows nothing, points are found by motion and the camera goes on as in plain odometry. Images must come in order of
/// time. Never prints, reads no files. Not thread safe; uses parallel_for inside, with the same bits for any number of
/// threads. With options.background the map belongs to a thread of the odometry's own, from construction until finish()
/// or destruction, and what the map throws there comes out of a later call of track() or of finish().
class Odometry {
 public:
  /// map must outlive this. T_world_camera_start: the camera's pose at the first image. Throws InputError on bad
  /// options.
  Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, const SE3& T_world_camera_start);

  // Its parts refer to each other.
  Odometry(const Odometry&) = delete;
  Odometry& operator=(const Odometry&) = delete;

  /// For a start pose that is not known: images are looked up until one is found. relocalizer: as for set_relocalizer.
  Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, Relocalizer& relocalizer);

  /// Looks up images in the map (same camera) once tracking is lost and no keyframe of the window fits: each of the
  /// first 15, then every fifth; and the first keyframes' until the map confirms the start pose. It must outlive this;
  /// null: the window is all that is searched. With options.background a look-up waits for the keyframe in the making.
  void set_relocalizer(Relocalizer* relocalizer) { relocalizer_ = relocalizer; }

  /// Finds the camera of the next image (the camera's size, grey 0..1, else InputError) taken at `time` [s]. view: what
  /// to look at in the map's place if this image becomes a keyframe, as with a depth sensor that came with the image;
  /// null: the map. With options.background this returns without waiting for the map once the first keyframe stands.
  TrackResult track(const GrayImage& image, double time, std::shared_ptr<MapView> view = nullptr);

  /// With options.background: waits for the keyframe in the making and takes it over. Else does nothing.
  void finish();

  /// Final estimate of every posed frame (TrajectoryRecord::compose). Lost frames are absent.
  Trajectory trajectory() const { return record_.compose(); }

  /// Times [s] of the images that have become keyframes, in order.
  std::vector<double> keyframe_times() const;

  OdometryStatistics statistics() const;
  /// With options.background only after finish().
  const Window& window() const { return backend_.window(); }

 private:
  /// Tracks the image of `request` against the keyframes, and asks for a keyframe where one is due.
  void follow(const GrayImage& image, KeyframeRequest& request, TrackResult& result);
  /// Looks the image up; where found, the window starts afresh from there. False: not found, not tried, or found where
  /// tracking has it (T_world_tracked).
  bool relocalise(const GrayImage& image, const KeyframeRequest& request, TrackResult& result,
                  const std::optional<SE3>& T_world_tracked = std::nullopt);
  /// Whether a pose may stand, by what the map says about it. to_be_confirmed: it does not follow from a pose that the
  /// map has confirmed.
  bool stands(const MapEvidence& evidence, const MisfitEffect& misfit, bool to_be_confirmed) const;
  /// Takes a tracked pose back, for what the map says about it, and looks the image up.
  void refuse(const GrayImage& image, const KeyframeRequest& request, TrackResult& result, const MapEvidence& evidence);
  /// Whether a posed frame counts as in the map. Where it does not although its keyframe's depth is the map's, its
  /// covariance grows as that of keyframes outside does.
  void judge(TrackResult& result);
  /// Asks for a keyframe and writes it into the result. False: there is none, or not yet.
  bool make_keyframe(const KeyframeRequest& request, TrackResult& result);
  void take_over(const std::optional<FinishedKeyframe>& finished);
  void render_ahead(const TrackedFrame& frame, double time);

  Camera camera_;
  OdometryOptions options_;
  std::optional<SE3> T_world_camera_start_;  // none: to be found
  FrameTracker front_;
  KeyframeBackend backend_;
  TrajectoryRecord record_;
  std::vector<StageTime> stages_{{"pyramid"}, {"track"}, {"relocalise"}};
  OdometryStatistics counts_;      // without stages
  double map_share_ = 0.0;         // of the last image that was tried as keyframe
  MapEvidence keyframe_evidence_;  // of the last image that was tried as keyframe
  MisfitEffect keyframe_misfit_;   // the same
  bool in_map_ = false;            // of the last keyframe
  bool rendered_ahead_ = false;
  Relocalizer* relocalizer_ = nullptr;
  int lost_in_a_row_ = 0;                      // images that show something
  int unconfirmed_ = 0;                        // posed frames since the map has confirmed one
  bool to_be_confirmed_ = false;               // the map spoke against the last keyframe
  std::unique_ptr<KeyframeWorker> keyframes_;  // last: it uses the back end until it is gone
};

}  // namespace odosplat
