// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/splat/corner_scene.hpp"

#include <cmath>

namespace odosplat::test {

namespace {

constexpr double wall_z = 2.0;
constexpr double floor_y = 0.5;

Eigen::Vector3f pattern(const Eigen::Vector3d& p) {
  const double a = std::sin(9.0 * p.x() + 2.0 * p.y()) * std::cos(7.0 * (p.y() + p.z()));
  const double b = std::cos(5.0 * p.x() - 6.0 * p.z() + 3.0 * p.y());
  return Eigen::Vector3d(0.5 + 0.35 * a, 0.5 + 0.3 * b, 0.5 - 0.2 * a * b).cast<float>();
}

/// Distance to the first plane that a ray meets, in units of the ray.
double meet(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  const double to_wall = (wall_z - origin.z()) / ray.z();
  const double to_floor = ray.y() > 0.0 ? (floor_y - origin.y()) / ray.y() : 1e9;
  return std::min(to_wall, to_floor);
}

}  // namespace

SE3 CornerScene::T_world_camera(int k) const {
  const Eigen::Vector3d position(0.04 * k - 0.2, 0.02 * std::sin(0.9 * k), 0.03 * std::cos(1.3 * k));
  return {so3_exp({-0.12, 0.01 * k - 0.05, 0.0}), position};
}

DepthImage CornerScene::depth(const SE3& T_world_camera) const {
  DepthImage image(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x)
      image(y, x) =
          static_cast<float>(meet(T_world_camera.translation(), T_world_camera.rotation() * camera.ray(x, y)));
  return image;
}

ColorImage CornerScene::color(const SE3& T_world_camera) const {
  ColorImage image(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const Eigen::Vector3d ray = T_world_camera.rotation() * camera.ray(x, y);
      const Eigen::Vector3f c = pattern(T_world_camera.translation() + meet(T_world_camera.translation(), ray) * ray);
      image(y, x) = cv::Vec3f(c.x(), c.y(), c.z());
    }
  }
  return image;
}

PointCloud CornerScene::cloud(double spacing) const {
  PointCloud cloud;
  const auto add = [&](const Eigen::Vector3d& p, const Eigen::Vector3f& normal) {
    cloud.points.push_back(p.cast<float>());
    cloud.colors.push_back(pattern(p));
    cloud.normals.push_back(normal);
  };
  const auto steps = [&](double length) { return static_cast<int>(length / spacing); };
  for (int i = 0; i <= steps(3.6); ++i) {
    const double x = -1.8 + i * spacing;
    for (int j = 0; j <= steps(2.0); ++j) add({x, floor_y - j * spacing, wall_z}, -Eigen::Vector3f::UnitZ());
    for (int j = 0; j <= steps(1.8); ++j) add({x, floor_y, wall_z - j * spacing}, -Eigen::Vector3f::UnitY());
  }
  return cloud;
}

CornerViews::CornerViews(int count) {
  for (int i = 0; i < count; ++i) images_.push_back(scene_.color(scene_.T_world_camera(2 * i)));
}

double depth_rmse(const DepthImage& depth, const DepthImage& truth, double& valid) {
  double sum = 0.0;
  int n = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (depth(y, x) <= 0.0F || truth(y, x) <= 0.0F) continue;
      const auto d = static_cast<double>(depth(y, x) - truth(y, x));
      sum += d * d;
      ++n;
    }
  }
  valid = static_cast<double>(n) / static_cast<double>(depth.total());
  return n > 0 ? std::sqrt(sum / n) : 0.0;
}

double psnr_db(const ColorImage& image, const ColorImage& truth) {
  double sum = 0.0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      const cv::Vec3f d = image(y, x) - truth(y, x);
      sum += static_cast<double>(d.dot(d));
    }
  }
  return -10.0 * std::log10(sum / (3.0 * static_cast<double>(image.total())));
}

}  // namespace odosplat::test
