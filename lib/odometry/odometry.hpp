// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/keyframe_maker.hpp"
#include "odosplat/odometry/keyframe_policy.hpp"
#include "odosplat/odometry/motion_model.hpp"
#include "odosplat/odometry/tracker.hpp"
#include "odosplat/odometry/window.hpp"
#include "odosplat/odometry/window_optimizer.hpp"

namespace odosplat {

class Relocalizer;

/// When an alignment is believed.
struct AcceptOptions {
  double min_inliers = 0.5;    // share of points in view that agree
  double min_coverage = 0.25;  // share of the reference's points in view
  double min_contrast = 0.5;   // the image's spread at the points over the expected one: a blank image has none
  double max_contrast = 2.0;
  // Of the image with the reference at its points, outliers included. Right poses reach 0.90 and more, on blurred real
  // images, too (median 0.99); images of another place or room, aligned as well as they can be, 0.07.
  double min_correlation = 0.5;
  double sure_correlation = 0.9;  // below, a frame that fits worse than the last one is looked up: is it elsewhere?
  // Of a keyframe with the map's rendered view, which must cover min_map_share of it. Right poses reach 0.71 and more
  // in the coarsest map. Where it falls below from one keyframe to the next, the camera is looked for elsewhere.
  double min_map_correlation = 0.3;
  double min_map_share = 0.6;
  double retrack = 1.5;            // residual over the last frame's beyond which other guesses are tried
  double retrack_outliers = 0.05;  // growth of the share of outliers beyond which they are tried, too
  double found_inliers = 0.7;      // as min_inliers, for a camera that was lost
  double found_coverage = 0.35;    // as min_coverage, for a camera that was lost

  void check() const;
};

struct OdometryOptions {
  TrackerOptions tracker;
  KeyframeMakerOptions keyframe;
  KeyframePolicyOptions policy;
  WindowOptions window;
  WindowOptimizerOptions optimizer;
  AcceptOptions accept;
  /// Neighbouring pixels err alike, which normal equations do not know: covariances out are theirs times this.
  double covariance_factor = 20.0;

  void check() const;
};

/// ok: tracked on from the last images. relocalised: found without them, after a loss or at a start without a pose.
enum class TrackStatus { ok, lost, relocalised };
/// "ok", "lost", "relocalised".
std::string to_string(TrackStatus status);

/// What became of one image. T_world_camera is the pose as known now; Odometry::trajectory() has the final one.
struct TrackResult {
  TrackStatus status = TrackStatus::lost;
  SE3 T_world_camera;                      // identity when lost: no pose is made up
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera; zero when lost
  bool keyframe = false;
  double inlier_share = 0.0;     // of the points in view
  double coverage = 0.0;         // share of the reference keyframe's points in view
  double rmse = 0.0;             // [grey] of the inliers
  double correlation = 0.0;      // of the image with the reference keyframe at its points, -1..1
  double map_correlation = 0.0;  // the same of the last keyframe attempt's image with the map's rendered view
  double map_share = 0.0;        // share of the last keyframe attempt's image where the map has depth
  bool anchored = false;         // a keyframe that the map's colours hold in place
  double milliseconds = 0.0;
};

/// Sums over all images so far.
struct OdometryStatistics {
  struct Stage {
    std::string name;
    double milliseconds = 0.0;
    long calls = 0;
  };
  std::vector<Stage> stages;  // pyramid, track, render, keyframe, optimise, relocalise
  int frames = 0;
  int posed = 0;
  int lost = 0;
  int relocalisations = 0;
  int keyframes = 0;
  int anchored = 0;
};

/// Direct sparse odometry in a prior map: every image gets its pose in the map's frame.
/// Source: the paper's local odometry (direct tracking against the last keyframe, sliding window of keyframes, depth of
/// keyframe points rendered from the map); Engel et al. 2018 (DSO) for selection, residuals and keyframe rule. Differs:
/// points keep to the map's planes when their keyframe moves, and every keyframe is also aligned with the map's
/// rendered image, which removes drift; no intrinsics are estimated; no null space is projected out. Images must come
/// in order of time. Never prints, reads no files. Not thread safe; uses parallel_for inside, with the same bits for
/// any number of threads.
class Odometry {
 public:
  /// map must outlive this. T_world_camera_start: the camera's pose at the first image. Throws InputError on bad
  /// options.
  Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, const SE3& T_world_camera_start);

  /// For a start pose that is not known: images are looked up until one is found. relocalizer: as for set_relocalizer.
  Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, Relocalizer& relocalizer);

  /// Looks up images in the map (same camera) once tracking is lost and no keyframe of the window fits: each of the
  /// first 15, then every fifth. It must outlive this; null: the window is all that is searched.
  void set_relocalizer(Relocalizer* relocalizer) { relocalizer_ = relocalizer; }

  /// Finds the camera of the next image (the camera's size, grey 0..1, else InputError) taken at `time` [s].
  TrackResult track(const GrayImage& image, double time);

  /// Final estimate: every posed frame's pose relative to its keyframe, composed with that keyframe's latest pose.
  /// Where the next keyframe's final pose is not where tracking had put it, the difference is spread over the frames
  /// between the two, so that the path has no step at keyframes. Lost frames are absent.
  Trajectory trajectory() const;

  const OdometryStatistics& statistics() const { return statistics_; }
  const Window& window() const { return window_; }

 private:
  struct FrameRecord {
    double time;
    int keyframe;
    SE3 T_keyframe_camera;
  };
  /// A keyframe's part in trajectory(), kept when it has left the window.
  struct KeyframeRecord {
    double time;
    SE3 T_world_camera;     // latest estimate
    int previous = -1;      // keyframe it was tracked against; -1: none
    SE3 T_previous_camera;  // where tracking had put it
  };

  Alignment track_against_newest(const FramePyramid& pyramid, double time);
  Alignment search_window(const FramePyramid& pyramid);
  /// Looks the image up; where found, the window starts afresh from there. False: not found, not tried, or found where
  /// tracking has it (T_world_tracked).
  bool relocalise(const GrayImage& image, const FramePyramid& pyramid, double time, TrackResult& result,
                  const std::optional<SE3>& T_world_tracked = std::nullopt);
  bool as_good_as_last(const Alignment& alignment) const;
  bool believed(const Alignment& alignment, bool was_lost) const;
  /// Whether the map has just stopped to look like the images.
  bool map_contradicts(const TrackResult& keyframe);
  bool add_keyframe(const FramePyramid& pyramid, double time, const SE3& T_world_camera, const Brightness& brightness,
                    TrackResult& result);
  void optimise();

  Camera camera_;
  MapView& map_;
  OdometryOptions options_;
  std::optional<SE3> T_world_camera_start_;  // none: to be found
  Tracker tracker_;
  KeyframeMaker maker_;
  WindowOptimizer optimizer_;
  Window window_;
  std::shared_ptr<Keyframe> reference_;  // tracked against: the newest keyframe, or after a loss another of the window
  std::vector<KeyframeRecord> keyframe_records_;  // by keyframe id
  std::vector<FrameRecord> records_;              // posed frames
  MotionHistory history_;
  Brightness relative_brightness_;  // of the last frame against reference_
  double first_rmse_ = 0.0;         // of the first frame after the keyframe
  double last_rmse_ = 0.0;
  double last_inlier_share_ = 1.0;
  bool lost_ = false;
  Relocalizer* relocalizer_ = nullptr;
  int lost_in_a_row_ = 0;    // images that show something
  bool map_agreed_ = false;  // at the last keyframe
  OdometryStatistics statistics_;
};

}  // namespace odosplat
