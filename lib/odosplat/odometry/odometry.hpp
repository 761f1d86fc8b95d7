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
  /// The errors of neighbouring pixels are correlated, and a map's colours are displaced by a fraction of a pixel over
  /// a whole view; the normal equations take residuals as independent. A frame's covariance is therefore the first
  /// factor times that of its alignment with its keyframe, plus the second factor times its keyframe's covariance, plus
  /// that of the camera's misfit (MisfitEffect). docs/rules.md has the mean normalised error squared that the factors
  /// give; 6 is the right value.
  double frame_covariance_factor = 1.0;
  double keyframe_covariance_factor = 40.0;
  /// Real time: keyframes are made on a thread of their own, while track() goes on with the existing keyframes. Which
  /// frame is tracked against which keyframe then depends on timing. false: track() makes them itself; same input, same
  /// bits.
  bool background = false;
  /// With background: the map is rendered this many images before the next keyframe is expected, at the pose predicted
  /// for it. The prediction by constant velocity is mostly right to 2 px two images ahead, less often three images
  /// ahead (docs/rules.md).
  double prefetch_images = 2.0;
  /// A pose where the map cannot be compared counts as in the map only up to this many frames after the last confirmed
  /// one.
  int max_unconfirmed = 10;
  /// A pose is refused if errors of the camera's calibration seem to have moved it by more than this: the estimate of
  /// larger errors is too rough to be expressed as a covariance.
  double max_misfit_translation = 0.05;  // [m]
  double max_misfit_rotation = 0.04;     // [rad]

  /// False if the misfit refuses the pose: an error of the camera that is probable by so many standard deviations moves
  /// it by more than the limits above.
  bool allows(const MisfitEffect& effect, double sigmas = MisfitEffect::significant_sigmas) const;
  MisfitLimits misfit_limits() const { return {max_misfit_translation, max_misfit_rotation}; }
  void check() const;
};

/// ok: tracked from the images before. relocalised: found without them, after a loss, or at a start whose pose is
/// unknown or wrong.
enum class TrackStatus { ok, lost, relocalised };
/// "ok", "lost", "relocalised".
std::string to_string(TrackStatus status);

/// The result for one image. T_world_camera is the current estimate; Odometry::trajectory() has the final one.
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
  /// How the image compares with the map at this pose; Confirmation::none where it was not compared, as with maps
  /// without colours.
  MapEvidence evidence;
  /// True if the last keyframe has its depth from the map, and the map confirms this pose, or cannot be compared here
  /// but has confirmed one of the last options.max_unconfirmed frames. A map without colours needs no confirmation.
  /// false: plain odometry.
  bool in_map = false;
  bool anchored = false;  // a keyframe aligned with the map's colours, or with remembered keyframes that were
  double misfit = 0.0;    // [m] how far errors of the camera's calibration seem to have moved the pose; part of its
                          // covariance
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
  std::string likely_cause;  // what is probably wrong with the camera, estimated from keyframes; empty: nothing
                             // significant
  int refused = 0;  // frames that were tracked, but contradicted by the map, not confirmed where that was needed, or
                    // moved too far by errors of the camera's calibration
};

/// Direct sparse odometry in a prior map: every image gets its pose in the map's frame.
/// Source: the paper's local odometry (direct tracking against the last keyframe, sliding window of keyframes, depth of
/// keyframe points rendered from the map); Engel et al. 2018 (DSO) for selection, residuals and keyframe rule. Differs:
/// points stay on the map's planes when their keyframe moves, and every keyframe is also aligned with the map's
/// rendered image, which removes drift; no intrinsics are estimated; no null space is projected out.
/// Where the map shows nothing, the depth of points is found by motion, as in odometry without a map. Images must come
/// in order of time. Never prints, reads no files. Not thread safe; uses parallel_for inside, with the same bits for
/// any number of threads. With options.background the map belongs to a thread of the odometry's own from construction
/// until finish() or destruction, and exceptions thrown there are rethrown by a later call of track() or finish().
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

  /// Sets the relocalizer (for the same camera), which must outlive this; null: only the window is searched. It looks
  /// up images once tracking is lost and no keyframe of the window fits: each of the first 15, then every fifth. It
  /// also looks up frames that the map contradicts, frames that must be confirmed and are not, as the first ones after
  /// a wrong start pose, and frames that suddenly fit worse. With options.background a look-up waits for the keyframe
  /// in the making.
  void set_relocalizer(Relocalizer* relocalizer) { relocalizer_ = relocalizer; }

  /// Finds the camera of the next image (the camera's size, grey 0..1, else InputError) taken at `time` [s]. view:
  /// rendered in place of the map if this image becomes a keyframe, for example a depth sensor's image; null: the map.
  /// With options.background this returns without waiting for the map once there is a keyframe, except for the first
  /// image found after a loss.
  TrackResult track(const GrayImage& image, double time, std::shared_ptr<MapView> view = nullptr);

  /// With options.background: waits for the keyframe in the making and takes it over. Else does nothing.
  void finish();

  /// Final estimate of every posed frame (TrajectoryRecord::compose). Lost frames are absent.
  Trajectory trajectory() const { return record_.compose(); }

  /// Times [s] of the images that have become keyframes, in order.
  std::vector<double> keyframe_times() const { return record_.keyframe_times(); }

  /// Takes the images before that time [s] out of trajectory(), and old keyframes out of keyframe_times(), so that the
  /// memory of a run of days is bounded. Tracking is not changed by it.
  void forget(double before) { record_.forget(before); }

  OdometryStatistics statistics() const;
  /// With options.background only after finish().
  const Window& window() const { return backend_.window(); }

 private:
  /// Tracks the image of `request` against the keyframes, and asks for a keyframe where one is due.
  void follow(const GrayImage& image, KeyframeRequest& request, TrackResult& result);
  /// Looks the image up; if it is found, the window starts anew from there. False: not found, not tried, or found at
  /// the pose that tracking gave (T_world_tracked).
  bool relocalise(const GrayImage& image, const KeyframeRequest& request, TrackResult& result,
                  const std::optional<SE3>& T_world_tracked = std::nullopt);
  /// Whether a pose is accepted, by its comparison with the map and by the camera's misfit. to_be_confirmed: the pose
  /// does not continue from one that the map has confirmed, so that it needs to be confirmed itself, and a misfit that
  /// is only likely (2 sigma) counts.
  bool stands(const MapEvidence& evidence, const MisfitEffect& misfit, bool to_be_confirmed) const;
  /// Discards a tracked pose because of its comparison with the map, and looks the image up.
  void refuse(const GrayImage& image, const KeyframeRequest& request, TrackResult& result, const MapEvidence& evidence);
  /// Decides whether a posed frame counts as in the map. If it does not although its keyframe has the map's depth, the
  /// drift of one keyframe (before any factor) is added to its covariance for every frame since the map last confirmed
  /// one.
  void judge(TrackResult& result);
  /// Asks for a keyframe and writes it into the result. wait: until it is made, though there are others to track
  /// against. False: there is none, or not yet.
  bool make_keyframe(const KeyframeRequest& request, TrackResult& result, bool wait = false);
  void take_over(const std::optional<FinishedKeyframe>& finished);
  void render_ahead(const TrackedFrame& tracked);

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
  int lost_in_a_row_ = 0;                      // since the last posed image; blank images are not counted
  int unconfirmed_ = 0;                        // posed frames since the map has confirmed one
  bool to_be_confirmed_ = false;               // the map contradicted the last keyframe
  std::unique_ptr<KeyframeWorker> keyframes_;  // declared last: it uses the back end until it is destroyed
};

}  // namespace odosplat
