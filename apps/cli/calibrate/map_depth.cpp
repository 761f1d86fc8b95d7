// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/cli/calibrate/map_depth.hpp"

#include <memory>
#include <opencv2/imgproc.hpp>

namespace odosplat::apps {
namespace {

/// Depth by a pinhole camera as the distorting one sees it.
DepthImage distorted(const DepthImage& depth, const Camera& pinhole, const CameraCorrection& correction,
                     const Camera& given) {
  cv::Mat2f places(depth.size());
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      const Eigen::Vector2d place = pinhole.project(correction.ray(given, x, y));
      places(y, x) = {static_cast<float>(place.x()), static_cast<float>(place.y())};
    }
  }
  DepthImage result;
  cv::remap(depth, result, places, cv::noArray(), cv::INTER_NEAREST, cv::BORDER_CONSTANT, cv::Scalar(0.0));
  return result;
}

}  // namespace

void take_depth_of_map(CameraFitInput& input, MapView& map) {
  const auto poses = std::make_shared<PosesOverTime>(input);
  for (std::size_t i = 0; i < input.has_depth.size(); ++i) input.has_depth[i] = input.T_world_camera[i].has_value();
  input.depth = [&map, poses, given = input.camera](std::size_t i, const CameraState& state) {
    const Camera pinhole = state.corrected(given);
    DepthImage depth = map.render(pinhole, poses->at(i, state.time_offset), {}).depth;
    return state.camera.radial == 0.0 ? depth : distorted(depth, pinhole, state.camera, given);
  };
}

}  // namespace odosplat::apps
