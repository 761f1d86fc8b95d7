// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Every posed frame relative to the keyframe that it was tracked against, and every keyframe's latest pose: together
/// the final trajectory, however the keyframes were moved after their frames had passed. Keyframes are counted from 0
/// in the order of add_keyframe.
class TrajectoryRecord {
 public:
  /// Frames come in order of time. found_again: the frames before it were lost.
  void add_frame(double time, int keyframe, const SE3& T_keyframe_camera, bool found_again = false);

  /// A frame has become the next keyframe, with T_world_camera as first estimate. If the frame was added before, its
  /// place against its own keyframe is kept as the far end of that keyframe's frames, unless the camera was lost in
  /// between or found_again says that it was found anew. Frames that came after it and were tracked against the same
  /// keyframe as it was are the new keyframe's from now on, where they stood relative to it. Returns the keyframe's
  /// number.
  int add_keyframe(double time, const SE3& T_world_camera, bool found_again = false);

  /// The frame of that time has no pose after all: it is left out of the trajectory. If it has become a keyframe,
  /// frames may still belong to that. Nothing if there is no such frame.
  void withdraw(double time);

  void move_keyframe(int keyframe, const SE3& T_world_camera);

  /// When the keyframe's image was taken [s].
  double keyframe_time(int keyframe) const { return keyframes_[static_cast<std::size_t>(keyframe)].time; }
  int keyframes() const { return static_cast<int>(keyframes_.size()); }

  /// Every frame's pose relative to its keyframe, composed with the keyframe's latest pose. Where the next keyframe's
  /// pose is not where tracking had put it, the difference is spread over the frames between the two, so that the path
  /// has no step at keyframes.
  Trajectory compose() const;

 private:
  struct Frame {
    double time;
    int keyframe;
    SE3 T_keyframe_camera;
    bool found_again = false;
  };
  struct Keyframe {
    double time;
    SE3 T_world_camera;
    int previous = -1;      // keyframe it was tracked against without a loss since; -1: none
    SE3 T_previous_camera;  // where tracking had put it
  };

  /// The first frame that is not before `time`.
  std::vector<Frame>::iterator frame_at(double time);

  std::vector<Keyframe> keyframes_;
  std::vector<Frame> frames_;
};

}  // namespace odosplat
