// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/trajectory.hpp"
#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/frame_tracker.hpp"
#include "odosplat/odometry/keyframe_backend.hpp"
#include "odosplat/odometry/trajectory_record.hpp"

namespace odosplat {

struct OdometryOptions {
  TrackerOptions tracker;
  KeyframeMakerOptions keyframe;
  KeyframePolicyOptions policy;
  WindowOptions window;
  WindowOptimizerOptions optimizer;
  MarginalisationOptions marginalisation;
  ActivationOptions activation;
  AcceptOptions accept;
  /// Neighbouring pixels err alike, which normal equations do not know: covariances out are theirs times this.
  double covariance_factor = 20.0;

  void check() const;
};

enum class TrackStatus { ok, lost, relocalised };
/// "ok", "lost", "relocalised".
std::string to_string(TrackStatus status);

/// What became of one image. T_world_camera is the pose as known now; Odometry::trajectory() has the final one.
struct TrackResult {
  TrackStatus status = TrackStatus::lost;  // relocalised: found again after a loss
  SE3 T_world_camera;                      // identity when lost: no pose is made up
  Matrix6d covariance = Matrix6d::Zero();  // of exp(xi) on the left of T_world_camera; zero when lost
  bool keyframe = false;
  double inlier_share = 0.0;  // of the points in view
  double coverage = 0.0;      // share of the reference keyframe's points in view
  double rmse = 0.0;          // [grey] of the inliers
  double map_share = 0.0;     // share of the last keyframe attempt's image where the map has depth
  bool in_map = false;        // the last keyframe has its depth from the map; false: plain odometry beyond it
  bool anchored = false;      // a keyframe that the map's colours hold in place
  double milliseconds = 0.0;
};

/// Sums over all images so far.
struct OdometryStatistics {
  std::vector<StageTime> stages;  // pyramid, track, render, keyframe, optimise, trace
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
/// rendered image, which removes drift; no intrinsics are estimated; no null space is projected out. Where the map
/// shows nothing, points are found by motion and the camera goes on as in plain odometry. Images must come in order of
/// time. Never prints, reads no files. Not thread safe; uses parallel_for inside, with the same bits for any number of
/// threads.
class Odometry {
 public:
  /// map must outlive this. T_world_camera_start: the camera's pose at the first image. Throws InputError on bad
  /// options.
  Odometry(const Camera& camera, MapView& map, const OdometryOptions& options, const SE3& T_world_camera_start);

  /// Finds the camera of the next image (the camera's size, grey 0..1, else InputError) taken at `time` [s].
  TrackResult track(const GrayImage& image, double time);

  /// Final estimate of every posed frame (TrajectoryRecord::compose). Lost frames are absent.
  Trajectory trajectory() const { return record_.compose(); }

  OdometryStatistics statistics() const;
  const Window& window() const { return backend_.window(); }

 private:
  void add_keyframe(const FramePyramid& pyramid, double time, const SE3& T_world_camera, const Brightness& brightness,
                    TrackResult& result);

  Camera camera_;
  OdometryOptions options_;
  SE3 T_world_camera_start_;
  FrameTracker front_;
  KeyframeBackend backend_;
  TrajectoryRecord record_;
  std::vector<StageTime> stages_{{"pyramid"}, {"track"}};
  OdometryStatistics counts_;  // without stages
  double map_share_ = 0.0;     // of the last attempt to make a keyframe
  bool in_map_ = false;        // of the last keyframe
};

}  // namespace odosplat
