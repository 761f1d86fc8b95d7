// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/camera/undistort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace odosplat {
namespace {

const Camera tum{640, 480, 517.306408, 516.469215, 318.643040, 255.313989};
const std::vector<double> tum_lens{0.262383, -0.953104, -0.005358, 0.002628, 1.163314};

// A smooth function of the ray, so that an undistorted image has a value known in closed form.
float pattern(double x, double y) {
  return static_cast<float>(0.5 + 0.25 * std::sin(4.0 * x) + 0.2 * std::cos(5.0 * y));
}

// The ray of a distorted pixel, by fixed-point iteration of the lens model.
Eigen::Vector2d ray_of_distorted(const Undistorter& undistorter, const Camera& camera, double u, double v) {
  Eigen::Vector2d p(u, v);
  for (int i = 0; i < 60; ++i) p += Eigen::Vector2d(u, v) - undistorter.distort(p.x(), p.y());
  const Eigen::Vector3d ray = camera.ray(p.x(), p.y());
  return {ray.x(), ray.y()};
}

TEST(Undistorter, NoDistortionReturnsTheImageItself) {
  const ColorImage image(480, 640, cv::Vec3f(0.1F, 0.2F, 0.3F));
  for (const std::vector<double>& none : {std::vector<double>{}, std::vector<double>{0, 0, 0, 0, 0}}) {
    const Undistorter undistorter(tum, none);
    EXPECT_TRUE(undistorter.is_identity());
    EXPECT_EQ(undistorter.color(image).data, image.data);
  }
}

// Comparison with OpenCV's projection.
TEST(Undistorter, DistortsAsOpenCvDoes) {
  const Undistorter undistorter(tum, tum_lens);
  const cv::Matx33d K(tum.fx, 0, tum.cx, 0, tum.fy, tum.cy, 0, 0, 1);
  for (const auto& [u, v] : {std::pair{0.0, 0.0}, {639.0, 0.0}, {100.5, 400.25}, {318.0, 255.0}}) {
    const Eigen::Vector3d ray = tum.ray(u, v);
    std::vector<cv::Point2d> projected;
    cv::projectPoints(std::vector<cv::Point3d>{{ray.x(), ray.y(), 1.0}}, cv::Vec3d(), cv::Vec3d(), K, tum_lens,
                      projected);
    EXPECT_NEAR(undistorter.distort(u, v).x(), projected[0].x, 1e-9);
    EXPECT_NEAR(undistorter.distort(u, v).y(), projected[0].y, 1e-9);
  }
}

TEST(Undistorter, RestoresAnAnalyticImage) {
  const Undistorter undistorter(tum, tum_lens);
  ColorImage distorted(480, 640);
  DepthImage distorted_depth(480, 640);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const Eigen::Vector2d ray = ray_of_distorted(undistorter, tum, u, v);
      distorted(v, u) = cv::Vec3f::all(pattern(ray.x(), ray.y()));
      distorted_depth(v, u) = static_cast<float>(2.0 + ray.x());
    }
  }
  const ColorImage color = undistorter.color(distorted);
  const DepthImage depth = undistorter.depth(distorted_depth);
  cv::Mat1f map_u;
  cv::Mat1f map_v;
  const cv::Matx33d K(tum.fx, 0, tum.cx, 0, tum.fy, tum.cy, 0, 0, 1);
  cv::initUndistortRectifyMap(K, tum_lens, cv::noArray(), K, {640, 480}, CV_32FC1, map_u, map_v);
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      const float inside = std::min({map_u(v, u), map_v(v, u), 639.0F - map_u(v, u), 479.0F - map_v(v, u)});
      ASSERT_TRUE(std::abs(inside) < 1e-3F || (depth(v, u) > 0.0F) == (inside > 0.0F)) << u << " " << v;
      if (depth(v, u) == 0.0F) continue;
      const Eigen::Vector3d ray = tum.ray(u, v);
      ASSERT_NEAR(color(v, u)[1], pattern(ray.x(), ray.y()), 1e-4) << u << " " << v;
      // The nearest pixel is at most 0.71 px away, slightly more where the lens magnifies.
      ASSERT_NEAR(depth(v, u), 2.0 + ray.x(), 1.2 / tum.fx) << u << " " << v;
    }
  }
}

TEST(Undistorter, DepthIsNeverMixed) {
  DepthImage step(480, 640, 1.0F);
  step(cv::Rect(320, 0, 320, 480)) = 5.0F;
  const DepthImage depth = Undistorter(tum, tum_lens).depth(step);
  for (const float z : depth) EXPECT_TRUE(z == 0.0F || z == 1.0F || z == 5.0F) << z;
}

TEST(Undistorter, WhatTheLensHasNotSeenIsZero) {
  // Pincushion: the corners of the undistorted image lie outside the distorted one.
  const Undistorter undistorter(tum, {0.5, 0.0, 0.0, 0.0});
  const ColorImage color = undistorter.color(ColorImage(480, 640, cv::Vec3f::all(1.0F)));
  const DepthImage depth = undistorter.depth(DepthImage(480, 640, 2.0F));
  EXPECT_EQ(color(0, 0), cv::Vec3f::all(0.0F));
  EXPECT_EQ(depth(479, 639), 0.0F);
  EXPECT_NEAR(color(240, 320)[0], 1.0F, 1e-6F);
  // Strong barrel distortion with one coefficient: r (1 - 0.6 r^2) has its maximum at r = 0.745; rays beyond it would
  // be projected to pixels of other rays.
  const Camera wide{640, 480, 300.0, 300.0, 319.5, 239.5};
  const DepthImage barrel = Undistorter(wide, {-0.6, 0.0, 0.0, 0.0}).depth(DepthImage(480, 640, 2.0F));
  EXPECT_EQ(barrel(240, 319 + 230), 0.0F);  // r = 0.77
  EXPECT_EQ(barrel(240, 319 + 215), 2.0F);  // r = 0.72
}

}  // namespace
}  // namespace odosplat
