// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/fit_input.hpp"

#include <opencv2/imgproc.hpp>

#include "apps/command/interrupt.hpp"
#include "odosplat/camera/register_depth.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat::apps {
namespace {

/// Depth as of the colour image's time, where the depth image has another one.
DepthImage depth_at_image(const Sequence& sequence, std::size_t i) {
  const std::optional<SE3> T_world_depth = sequence.T_world_depth(i);
  if (!T_world_depth || !sequence.T_world_camera(i)) return {};
  const SE3 T_camera_depth = sequence.T_world_camera(i)->inverse() * *T_world_depth;
  DepthImage depth = sequence.depth(i);
  if (T_camera_depth.log().norm() < 1e-6) return depth;
  return registered_depth(depth, sequence.camera(), T_camera_depth, sequence.camera());
}

}  // namespace

CameraFitInput camera_fit_input(const Sequence& sequence) {
  constexpr int widest = 800;  // [px]
  int level = 0;
  while (sequence.camera().width >> level > widest) ++level;
  CameraFitInput input;
  input.camera = sequence.camera().level(level);
  for (std::size_t i = 0; i < sequence.size(); ++i) {
    input.times.push_back(sequence.time(i));
    input.T_world_camera.push_back(sequence.T_world_camera(i));
    input.has_depth.push_back(sequence.has_depth(i));
  }
  input.gray = [&sequence, level](std::size_t i) {
    if (interrupted()) throw Interrupted();
    GrayImage gray = sequence.gray(i);
    for (int k = 0; k < level; ++k) gray = halve(gray);
    return gray;
  };
  input.depth = [&sequence, size = cv::Size(input.camera.width, input.camera.height)](std::size_t i,
                                                                                      const CameraState&) {
    if (interrupted()) throw Interrupted();
    if (!sequence.has_depth(i)) return DepthImage();
    DepthImage depth = depth_at_image(sequence, i);
    if (!depth.empty() && depth.size() != size) cv::resize(depth, depth, size, 0.0, 0.0, cv::INTER_NEAREST);
    return depth;
  };
  return input;
}

}  // namespace odosplat::apps
