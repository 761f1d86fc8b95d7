// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/sequence/sequence_poses.hpp"

#include <cstddef>
#include <optional>
#include <vector>

#include "odosplat/core/log.hpp"
#include "odosplat/core/near_origin.hpp"
#include "odosplat/io/sequence/layout_parts.hpp"

namespace odosplat {

void reflect_poses(SequenceIndex& index) {
  for (FrameFiles& f : index.frames) {
    if (f.T_world_camera) f.T_world_camera = reflected(*f.T_world_camera);
    if (f.T_world_depth) f.T_world_depth = reflected(*f.T_world_depth);
  }
  for (StampedPose& pose : index.truth) pose.T_world_camera = reflected(pose.T_world_camera);
}

Trajectory set_poses(const std::string& name, SequenceIndex& index) {
  const double offset = index.camera.time_offset;
  const double depth_offset = index.camera.depth_time_offset();
  std::size_t unposed = 0;
  std::size_t unposed_depth = 0;
  for (FrameFiles& f : index.frames) {
    if (!index.poses_by_time && f.T_world_camera) {
      const SE3 at_stamp = *f.T_world_camera;
      const auto pose_after = [&](double seconds) {
        return seconds == 0.0 ? std::optional<SE3>(at_stamp) : pose_at(index.truth, f.time + seconds);
      };
      f.T_world_depth = pose_after(depth_offset);
      f.T_world_camera = pose_after(offset);
    }
    if (!f.T_world_camera && offset != 0.0 && pose_at(index.truth, f.time)) ++unposed;
    if (f.depth.empty()) {
      f.T_world_depth = f.T_world_camera;
    } else if (depth_offset == offset) {
      if (!f.T_world_depth) f.T_world_depth = f.T_world_camera;
    } else if (!f.T_world_camera) {
      f.T_world_depth.reset();
    } else {
      unposed_depth += f.T_world_depth ? 0 : 1;
    }
  }
  if (unposed_depth > 0) {
    log_warning(name + ": " + std::to_string(unposed_depth) + " depth images have no pose at their time" +
                (depth_offset == 0.0 ? "" : ", which time_offset of depth_camera moves"));
  }
  if (offset == 0.0 || index.truth.empty()) return {};
  if (unposed > 0) {
    log_warning(name + ": " + std::to_string(unposed) + " of " + std::to_string(index.frames.size()) +
                " images have no pose at their time, which time_offset of " + index.camera_source + " moves");
  }
  Trajectory truth_of_images;
  for (const FrameFiles& f : index.frames) {
    if (f.T_world_camera) truth_of_images.push_back({f.time, *f.T_world_camera, f.time_text});
  }
  return truth_of_images;
}

void require_near(const std::string& name, const SequenceIndex& index) {
  require_near_origin(name, index.truth);
  std::vector<Eigen::Vector3d> positions;
  for (const FrameFiles& f : index.frames) {
    if (f.T_world_camera) positions.push_back(f.T_world_camera->translation());
  }
  require_near_origin(name, positions);
}

}  // namespace odosplat
