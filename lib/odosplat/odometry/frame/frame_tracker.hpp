// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/frame/motion_model.hpp"
#include "odosplat/odometry/frame/posed_frame.hpp"
#include "odosplat/odometry/frame/reference_frame.hpp"
#include "odosplat/odometry/keyframe/keyframe_policy.hpp"

namespace odosplat {

/// When an alignment is accepted.
struct AcceptOptions {
  double min_inliers = 0.5;    // share of points in view that agree
  double min_coverage = 0.25;  // share of the reference's points in view
  double min_contrast = 0.5;   // spread of the image's values at the points over the expected one; 0 for a blank image
  double max_contrast = 2.0;
  // Of the image's values with the reference's at its points, outliers included. Right poses reach 0.9 and more, also
  // with blurred images; an image of another place stays near 0 even where it fits best.
  double min_correlation = 0.5;
  double sure_correlation = 0.9;  // below, a frame that fits worse than the last one is looked up, as it may be
                                  // elsewhere
  // Prior of the deviation from constant velocity between two frames, for motions that the image does not determine.
  double motion_translation = 0.005;  // [m] standard deviation
  double motion_rotation = 0.005;     // [rad] standard deviation
  double retrack = 1.5;               // residual over the last frame's beyond which other guesses are tried
  double retrack_outliers = 0.05;     // growth of the share of outliers beyond which they are tried, too
  double found_inliers = 0.7;         // as min_inliers, for a camera that was lost
  double found_coverage = 0.35;       // as min_coverage, for a camera that was lost

  void check() const;
};

struct FrameTrackerOptions {
  ImageAlignerOptions aligner;
  KeyframePolicyOptions policy;
  AcceptOptions accept;

  void check() const;
};

/// The pose of a frame, by the keyframe it was compared with.
struct TrackedFrame {
  bool found = false;
  bool was_lost = false;  // tracking was lost before this frame
  PosedFrame frame;       // its image as it was compared
  Alignment alignment;    // against the reference
  int keyframe = -1;      // the reference's number
  SE3 T_keyframe_camera;
  // Of exp(xi) on the left of T_world_camera, before any factor: of the alignment alone, and of the keyframe.
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d keyframe_covariance = Matrix6d::Zero();
  MapEvidence evidence;         // how the image compares with the map as seen from about the keyframe
  bool doubtful = false;        // accepted, but it fits worse than the last frame and may be elsewhere
  MisfitEffect misfit;          // effect of errors of the camera's calibration on the keyframe's pose
  bool verifiable = false;      // the map has colours, and the keyframe's depth is the map's
  bool after_gap = false;       // the last frame is several intervals old
  double keyframe_score = 0.0;  // beyond 1 the frame should become a keyframe
  bool keyframe_due() const { return keyframe_score > 1.0; }
};

/// The odometry's front end: aligns every frame with the newest keyframe, from several guesses if need be; after a loss
/// it tries all keyframes that it knows. Source: DSO's tracking by several motion hypotheses. Not thread safe.
class FrameTracker {
 public:
  explicit FrameTracker(const FrameTrackerOptions& options);

  /// No keyframe to compare with yet.
  bool empty() const { return references_.empty(); }
  /// Not if empty().
  const ReferenceFrame& newest() const { return references_.back(); }

  /// Finds the frame, of which number, time and image count. Afterwards the caller must call confirm() with the final
  /// pose, which a new keyframe may have changed, or lose().
  TrackedFrame track(const PosedFrame& frame);

  /// Takes over the back end's keyframes (oldest first, not empty). If the newest is new, frames are aligned with it
  /// from now on; otherwise with the same keyframe as before, if that is still there. T_new_old: correction that the
  /// back end has made to the tracked pose of the newest keyframe, on the left. The frames of the motion history are
  /// corrected too, so that the correction is not taken for motion.
  void set_references(std::vector<ReferenceFrame> references, const SE3& T_new_old);

  /// The last frame is at T_world_camera.
  void confirm(double time, const SE3& T_world_camera);
  /// The last frame was not found.
  void lose();
  bool lost() const { return lost_; }
  const MotionHistory& history() const { return history_; }

  const ImageAligner& aligner() const { return aligner_; }

 private:
  const ReferenceFrame& reference() const { return references_[current_]; }
  Alignment track_against_reference(const FramePyramid& pyramid, double time) const;
  Alignment search_references(const FramePyramid& pyramid);
  /// The image as taken, of a rolling shutter with the motion that the history predicts.
  std::shared_ptr<const FramePyramid> with_predicted_rows(const PosedFrame& frame) const;
  /// Aligns the image of a rolling shutter again, with the motion of its rows that follows from its pose.
  void measure_rows(TrackedFrame& tracked) const;
  bool as_good_as_last(const Alignment& alignment) const;
  bool believed(const Alignment& alignment, bool was_lost) const;

  FrameTrackerOptions options_;
  ImageAligner aligner_;
  std::vector<ReferenceFrame> references_;  // oldest first
  std::size_t current_ = 0;                 // tracked against: the newest, or after a loss another
  MotionHistory history_;
  RowGain last_row_gain_;
  Brightness last_brightness_;      // of the last frame itself
  Brightness relative_brightness_;  // of the last frame against the reference
  double first_rmse_ = 0.0;         // of the first frame after the keyframe
  double last_rmse_ = 0.0;
  double last_inlier_share_ = 1.0;
  bool lost_ = false;
};

}  // namespace odosplat
