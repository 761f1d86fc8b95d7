// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/frame/row_shift.hpp"

#include <opencv2/imgproc.hpp>

namespace odosplat {
namespace {

double mean_inverse_depth(const DepthImage& depth) {
  double sum = 0.0;
  int count = 0;
  for (int v = 0; v < depth.rows; ++v) {
    for (int u = 0; u < depth.cols; ++u) {
      if (!(depth(v, u) > 0.0F)) continue;
      sum += 1.0 / depth(v, u);
      ++count;
    }
  }
  return count > 0 ? sum / count : 0.0;
}

}  // namespace

SE3 at_its_row(const SE3& T_camera_view, const Camera& camera, const Eigen::Vector3d& p_view,
               const Vector6d& row_motion) {
  const Eigen::Vector3d p = T_camera_view * p_view;
  if (!(p.z() > 0.01)) return T_camera_view;
  const double s = std::clamp(camera.time_of_row(camera.project(p).y()), -beyond_rows, beyond_rows);
  return SE3::exp(s * row_motion) * T_camera_view;
}

FramePyramid with_row_motion(const FramePyramid& image, const Vector6d& row_motion) {
  FramePyramid moved = image;
  moved.row_motion = row_motion;
  return moved;
}

FramePyramid with_rows_together(const FramePyramid& image, const DepthImage& depth) {
  constexpr double least = 1e-3;  // [1/m] inverse depth
  const Camera& camera = image.cameras.front();
  const RowShift<double> rows(camera, image.row_motion);
  const double usual = std::max(least, mean_inverse_depth(depth));
  cv::Mat1f us(camera.height, camera.width);
  cv::Mat1f vs(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const bool known = !depth.empty() && depth(v, u) > 0.0F;
      const double z = known ? depth(v, u) : 1.0 / usual;
      const Eigen::Vector2d uv = camera.project(rows.at(z * camera.ray(u, v)));
      us(v, u) = static_cast<float>(uv.x());
      vs(v, u) = static_cast<float>(uv.y());
    }
  }
  // Level 0 is smoothed already, so that interpolation changes it little; cubic, as linear would smooth it further.
  GrayImage together;
  cv::remap(image.gray.front(), together, us, vs, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return build_frame_pyramid(camera, together);
}

}  // namespace odosplat
