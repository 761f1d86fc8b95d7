// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/odometry/box_room.hpp"

#include <cmath>

namespace odosplat::test {

double BoxRoom::texture(const Eigen::Vector3d& p) const {
  // Waves of several directions, so that each wall has texture in both directions; the finest are about 6 pixels long
  // at 3 m.
  const double s = detail;
  double value = 0.5;
  value += 0.12 * std::sin(s * (5.0 * p.x() + 3.0 * p.y() + 4.0 * p.z()));
  value += 0.10 * std::sin(s * (-7.0 * p.x() + 9.0 * p.y() + 2.0 * p.z()) + 1.0);
  value += 0.08 * std::sin(s * (13.0 * p.x() + 4.0 * p.y() - 15.0 * p.z()) + 2.0);
  value += 0.06 * std::sin(s * (6.0 * p.x() - 19.0 * p.y() + 17.0 * p.z()) + 0.5);
  return value;
}

double BoxRoom::depth(const Camera& camera, const SE3& T_world_camera, double u, double v) const {
  const Eigen::Vector3d direction = T_world_camera.rotation() * camera.ray(u, v);
  const Eigen::Vector3d& origin = T_world_camera.translation();
  double nearest = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) continue;
    const double wall = direction[axis] > 0.0 ? half_size[axis] : -half_size[axis];
    nearest = std::min(nearest, (wall - origin[axis]) / direction[axis]);
  }
  return nearest;
}

ViewImages BoxRoom::render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) {
  ++renders;
  ViewImages view;
  const cv::Size size(camera.width, camera.height);
  view.depth = DepthImage::zeros(size);
  view.sigma = cv::Mat1f::zeros(size);
  if (request.alpha) view.alpha = cv::Mat1f::zeros(size);
  if (request.color && with_color) view.color = ColorImage::zeros(size);
  if (!with_depth) return view;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const double z = depth(camera, T_world_camera, x, y);
      if ((T_world_camera * (z * camera.ray(x, y))).x() < mapped_from) continue;
      view.depth(y, x) = static_cast<float>(z * depth_factor);
      view.sigma(y, x) = 0.002F;
      if (!view.alpha.empty()) view.alpha(y, x) = 1.0F;
      if (view.color.empty()) continue;
      const double value = std::pow(texture(T_world_camera * (z * camera.ray(x, y))), gamma);
      view.color(y, x) = cv::Vec3f::all(static_cast<float>(value));
    }
  }
  return view;
}

GrayImage BoxRoom::gray(const Camera& camera, const SE3& T_world_camera) const {
  GrayImage image(camera.height, camera.width);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const double z = depth(camera, T_world_camera, x, y);
      image(y, x) = static_cast<float>(texture(T_world_camera * (z * camera.ray(x, y))));
    }
  }
  return image;
}

GrayImage BoxRoom::gray(const Camera& camera, const std::function<SE3(double seconds)>& T_world_camera) const {
  GrayImage image(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    Camera row = camera;
    row.height = 1;
    row.cy -= v;
    gray(row, T_world_camera(camera.readout * camera.time_of_row(v))).copyTo(image.row(v));
  }
  return image;
}

Camera small_camera() { return {160, 120, 121.0, 120.0, 79.3, 59.8}; }

SE3 room_path(double k) {
  const double t = k / 30.0;
  const Eigen::Vector3d position(0.4 * std::sin(0.9 * t), 0.15 * std::sin(1.7 * t), 0.5 * std::sin(0.6 * t));
  const Eigen::Vector3d turn(0.12 * std::sin(1.1 * t), 0.35 * std::sin(0.7 * t), 0.08 * std::sin(1.3 * t));
  return {so3_exp(turn), position};
}

}  // namespace odosplat::test
