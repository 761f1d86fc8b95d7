// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/trajectory_record.hpp"

#include <algorithm>

namespace odosplat {

void TrajectoryRecord::add_frame(double time, int keyframe, const SE3& T_keyframe_camera) {
  frames_.push_back({time, keyframe, T_keyframe_camera});
}

int TrajectoryRecord::add_keyframe(double time, const SE3& T_world_camera) {
  const int id = static_cast<int>(keyframes_.size());
  Keyframe keyframe{time, T_world_camera, -1, {}};
  // The frame's own record moves over to its keyframe: its pose is the keyframe's from now on. It is the newest, or a
  // few frames back where the back end took its time.
  const auto at = std::lower_bound(frames_.begin(), frames_.end(), time,
                                   [](const Frame& frame, double stamp) { return frame.time < stamp; });
  if (at != frames_.end() && at->time == time) {
    keyframe.previous = at->keyframe;
    keyframe.T_previous_camera = at->T_keyframe_camera;
    *at = {time, id, SE3()};
  } else {
    frames_.insert(at, {time, id, SE3()});
  }
  keyframes_.push_back(keyframe);
  return id;
}

void TrajectoryRecord::move_keyframe(int keyframe, const SE3& T_world_camera) {
  keyframes_[static_cast<std::size_t>(keyframe)].T_world_camera = T_world_camera;
}

Trajectory TrajectoryRecord::compose() const {
  // Keyframe that was tracked against keyframe k, if any: the far end of the frames that belong to k.
  std::vector<int> next(keyframes_.size(), -1);
  for (std::size_t id = 0; id < keyframes_.size(); ++id) {
    const int previous = keyframes_[id].previous;
    if (previous >= 0) next[static_cast<std::size_t>(previous)] = static_cast<int>(id);
  }
  Trajectory trajectory;
  trajectory.reserve(frames_.size());
  for (const Frame& frame : frames_) {
    const Keyframe& host = keyframes_[static_cast<std::size_t>(frame.keyframe)];
    SE3 T_world_camera = host.T_world_camera * frame.T_keyframe_camera;
    const int far = next[static_cast<std::size_t>(frame.keyframe)];
    if (far >= 0) {
      const Keyframe& end = keyframes_[static_cast<std::size_t>(far)];
      const double share = (frame.time - host.time) / (end.time - host.time);
      // The correction is a motion of the camera in its own frame: a small turn must not swing it about the world's
      // origin.
      const SE3 correction = (host.T_world_camera * end.T_previous_camera).inverse() * end.T_world_camera;
      if (share > 0.0 && share < 1.0) T_world_camera = T_world_camera * SE3::exp(share * correction.log());
    }
    trajectory.push_back({frame.time, T_world_camera, ""});
  }
  return trajectory;
}

}  // namespace odosplat
