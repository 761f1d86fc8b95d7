// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/perspective_pose.hpp"

#include <opencv2/calib3d.hpp>

#include "odosplat/core/error.hpp"

namespace odosplat {

void PerspectivePoseOptions::check() const {
  require(iterations >= 1, "pose.iterations", "at least 1");
  require(max_error > 0.0, "pose.max_error", "positive");
  require(min_inliers >= 4, "pose.min_inliers", "at least 4");
}

std::optional<PerspectivePose> perspective_pose(const Camera& camera, const std::vector<PointMatch>& matches,
                                                const PerspectivePoseOptions& options) {
  if (static_cast<int>(matches.size()) < options.min_inliers) return std::nullopt;
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  points.reserve(matches.size());
  pixels.reserve(matches.size());
  for (const PointMatch& match : matches) {
    points.emplace_back(match.p_world.x(), match.p_world.y(), match.p_world.z());
    pixels.emplace_back(match.pixel.x, match.pixel.y);
  }
  const cv::Matx33d K(camera.fx, 0.0, camera.cx, 0.0, camera.fy, camera.cy, 0.0, 0.0, 1.0);
  cv::Vec3d rotation;
  cv::Vec3d translation;
  std::vector<int> inliers;
  const bool found =
      cv::solvePnPRansac(points, pixels, K, cv::noArray(), rotation, translation, false, options.iterations,
                         static_cast<float>(options.max_error), 0.999, inliers, cv::SOLVEPNP_AP3P);
  if (!found || static_cast<int>(inliers.size()) < options.min_inliers) return std::nullopt;
  const SE3 T_camera_world(so3_exp({rotation[0], rotation[1], rotation[2]}),
                           {translation[0], translation[1], translation[2]});
  if (!T_camera_world.is_finite()) return std::nullopt;
  return PerspectivePose{T_camera_world.inverse(), static_cast<int>(inliers.size())};
}

}  // namespace odosplat
