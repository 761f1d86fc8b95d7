// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/relocalise/camera_watch.hpp"

namespace odosplat::apps {

PoseByCamera CameraWatch::add(const GrayImage& image, const SE3& T_world_camera) {
  const double smoothing = options_.keyframe.smoothing;
  const ViewPatches patches(camera_, {T_world_camera, map_.render(camera_, T_world_camera, {true, false})}, smoothing,
                            options_.confirmation);
  const FramePyramid pyramid = build_frame_pyramid(camera_, image, smoothing);
  if (patches.compare(pyramid, T_world_camera).verdict != Confirmation::confirmed) return {};
  return misfit_.add(patches, pyramid, T_world_camera, Vector6d::Zero());
}

std::string CameraWatch::fault_of(const PoseByCamera& pose) const {
  if (!pose.determined) return likely_cause();
  return options_.allows(misfit_.effect(pose, camera_)) ? "" : likely_cause();
}

}  // namespace odosplat::apps
