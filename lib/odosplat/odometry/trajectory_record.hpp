// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <vector>

#include "odosplat/core/trajectory.hpp"

namespace odosplat {

/// Every posed frame relative to the keyframe that it was tracked against, and every keyframe's latest pose. Composed,
/// they give the final trajectory, with all corrections that keyframes received after their frames were tracked.
/// Keyframes are counted from 0 in the order of add_keyframe.
class TrajectoryRecord {
 public:
  /// Frames come in order of time. found_again: the frames before it were lost.
  void add_frame(double time, int keyframe, const SE3& T_keyframe_camera, bool found_again = false);

  /// The frame at `time` has become the next keyframe, with T_world_camera as first estimate. If the frame was added
  /// before, its tracked pose relative to its own keyframe is kept, for compose() to spread corrections between the
  /// two, unless the camera was lost in between or found_again is set. Later frames that were tracked against the same
  /// keyframe as this frame are assigned to the new keyframe, with their poses relative to it. Returns the keyframe's
  /// number.
  int add_keyframe(double time, const SE3& T_world_camera, bool found_again = false);

  /// Removes the frame of that time from the trajectory. If it has become a keyframe, the keyframe stays, as frames may
  /// belong to it. Does nothing if there is no such frame.
  void withdraw(double time);

  void move_keyframe(int keyframe, const SE3& T_world_camera);

  /// Forgets all frames before that time [s], which bounds the memory of a long run, and keyframes that no remaining
  /// frame belongs to, except for the newest 100. Keyframes that are asked for later must be among those.
  void forget(double before);

  /// When the keyframe's image was taken [s].
  double keyframe_time(int keyframe) const { return at(keyframe).time; }
  /// Times [s] of the keyframes that are not forgotten, in order of add_keyframe.
  std::vector<double> keyframe_times() const;

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
  const Keyframe& at(int keyframe) const { return keyframes_[static_cast<std::size_t>(keyframe - first_)]; }

  int first_ = 0;  // number of the first keyframe that is not forgotten
  std::vector<Keyframe> keyframes_;
  std::vector<Frame> frames_;
};

}  // namespace odosplat
