// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/trajectory_record.hpp"

#include <algorithm>

namespace odosplat {

void TrajectoryRecord::add_frame(double time, int keyframe, const SE3& T_keyframe_camera, bool found_again) {
  frames_.push_back({time, keyframe, T_keyframe_camera, found_again});
}

std::vector<TrajectoryRecord::Frame>::iterator TrajectoryRecord::frame_at(double time) {
  return std::lower_bound(frames_.begin(), frames_.end(), time,
                          [](const Frame& frame, double stamp) { return frame.time < stamp; });
}

int TrajectoryRecord::add_keyframe(double time, const SE3& T_world_camera, bool found_again) {
  const int id = first_ + static_cast<int>(keyframes_.size());
  Keyframe keyframe{time, T_world_camera, -1, {}};
  // The frame is assigned to its own keyframe, so that its pose is the keyframe's. It is the newest frame, or a few
  // frames old if the back end was slow.
  const auto at = frame_at(time);
  if (at != frames_.end() && at->time == time) {
    const int previous = at->keyframe;
    const SE3 T_keyframe_previous = at->T_keyframe_camera.inverse();
    for (auto later = at + 1; later != frames_.end() && !later->found_again; ++later) {
      if (later->keyframe == previous) {
        *later = {later->time, id, T_keyframe_previous * later->T_keyframe_camera};
      }
    }
    bool lost_between = found_again || at->found_again;
    for (auto earlier = at; !lost_between && earlier != frames_.begin(); --earlier) {
      if (earlier->time <= keyframe_time(previous)) break;
      lost_between = earlier->found_again;
    }
    if (!lost_between) {
      keyframe.previous = previous;
      keyframe.T_previous_camera = at->T_keyframe_camera;
    }
    *at = {time, id, SE3(), found_again || at->found_again};
  } else {
    frames_.insert(at, {time, id, SE3(), found_again});
  }
  keyframes_.push_back(keyframe);
  return id;
}

void TrajectoryRecord::withdraw(double time) {
  const auto at = frame_at(time);
  if (at != frames_.end() && at->time == time) frames_.erase(at);
}

void TrajectoryRecord::move_keyframe(int keyframe, const SE3& T_world_camera) {
  // A keyframe that is forgotten has no frames, so that its pose does not matter.
  if (keyframe >= first_) keyframes_[static_cast<std::size_t>(keyframe - first_)].T_world_camera = T_world_camera;
}

void TrajectoryRecord::forget(double before) {
  constexpr int newest = 100;
  frames_.erase(frames_.begin(), frame_at(before));
  int needed = first_ + static_cast<int>(keyframes_.size()) - newest;
  for (const Frame& frame : frames_) needed = std::min(needed, frame.keyframe);
  if (needed <= first_) return;
  keyframes_.erase(keyframes_.begin(), keyframes_.begin() + (needed - first_));
  first_ = needed;
}

std::vector<double> TrajectoryRecord::keyframe_times() const {
  std::vector<double> times;
  times.reserve(keyframes_.size());
  for (const Keyframe& keyframe : keyframes_) times.push_back(keyframe.time);
  return times;
}

Trajectory TrajectoryRecord::compose() const {
  // Keyframe that was tracked against keyframe k, if any: it ends the interval of the frames that belong to k.
  std::vector<int> next(keyframes_.size(), -1);
  for (std::size_t id = 0; id < keyframes_.size(); ++id) {
    const int previous = keyframes_[id].previous;
    if (previous >= first_) next[static_cast<std::size_t>(previous - first_)] = first_ + static_cast<int>(id);
  }
  Trajectory trajectory;
  trajectory.reserve(frames_.size());
  for (const Frame& frame : frames_) {
    const Keyframe& host = at(frame.keyframe);
    SE3 T_world_camera = host.T_world_camera * frame.T_keyframe_camera;
    const int far = next[static_cast<std::size_t>(frame.keyframe - first_)];
    if (far >= 0) {
      const Keyframe& end = at(far);
      const double share = (frame.time - host.time) / (end.time - host.time);
      // The correction is a motion in the camera's own frame: applied in the world's frame, a small rotation would move
      // the camera about the world's origin.
      const SE3 correction = (host.T_world_camera * end.T_previous_camera).inverse() * end.T_world_camera;
      if (share > 0.0 && share < 1.0) T_world_camera = T_world_camera * SE3::exp(share * correction.log());
    }
    trajectory.push_back({frame.time, T_world_camera, ""});
  }
  return trajectory;
}

}  // namespace odosplat
