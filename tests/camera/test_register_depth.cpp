// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/camera/register_depth.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const Camera depth_camera{80, 60, 73.0, 73.5, 40.2, 29.1};
const Camera color_camera{64, 52, 52.5, 52.0, 31.5, 25.0};
// About as in a Kinect.
const SE3 T_color_depth(so3_exp({0.004, -0.008, 0.003}), {-0.025, 0.001, 0.002});

/// z of the plane n . p = d, in the frame of the camera, along the ray of a pixel.
double plane_depth(const Camera& camera, const Eigen::Vector3d& n, double d, double u, double v) {
  return d / n.dot(camera.ray(u, v));
}

DepthImage plane_image(const Camera& camera, const Eigen::Vector3d& n, double d) {
  DepthImage image(camera.height, camera.width);
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) image(y, x) = static_cast<float>(plane_depth(camera, n, d, x, y));
  }
  return image;
}

TEST(RegisteredDepth, OfTheSameCameraIsTheImage) {
  DepthImage image = plane_image(depth_camera, {0.1, -0.2, 0.97}, 2.0);
  image(20, 30) = 0.0F;
  const DepthImage registered = registered_depth(image, depth_camera, SE3(), depth_camera);
  int missing = 0;
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      if (registered(y, x) == 0.0F) {
        ++missing;
      } else {
        EXPECT_NEAR(registered(y, x), image(y, x), 2e-6F) << x << " " << y;
      }
    }
  }
  EXPECT_EQ(missing, 1);
}

TEST(RegisteredDepth, OfAPlaneIsThePlaneInTheColourCamera) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.2, 1.0).normalized();
  const double d = 1.7;
  const DepthImage registered =
      registered_depth(plane_image(depth_camera, n, d), depth_camera, T_color_depth, color_camera);
  ASSERT_EQ(registered.size(), cv::Size(color_camera.width, color_camera.height));
  const Eigen::Vector3d n_color = T_color_depth.rotation() * n;
  const double d_color = d + n_color.dot(T_color_depth.translation());
  int inside = 0;
  int covered = 0;
  for (int y = 0; y < registered.rows; ++y) {
    for (int x = 0; x < registered.cols; ++x) {
      const double z = plane_depth(color_camera, n_color, d_color, x, y);
      const Eigen::Vector2d seen = depth_camera.project(T_color_depth.inverse() * (z * color_camera.ray(x, y)));
      const bool visible = seen.x() > 0.01 && seen.x() < depth_camera.width - 1.01 && seen.y() > 0.01 &&
                           seen.y() < depth_camera.height - 1.01;
      inside += visible ? 1 : 0;
      if (registered(y, x) == 0.0F) {
        EXPECT_FALSE(visible) << x << " " << y;
        continue;
      }
      ++covered;
      EXPECT_NEAR(registered(y, x), z, 1e-5) << x << " " << y;
    }
  }
  EXPECT_GT(inside, registered.rows * registered.cols / 2);
  EXPECT_GE(covered, inside);
}

TEST(RegisteredDepth, KeepsTheNearestSurfaceAndMakesNoneBetweenTwo) {
  constexpr float near = 0.8F;
  constexpr float far = 2.5F;
  DepthImage image(depth_camera.height, depth_camera.width, far);
  image(cv::Rect(30, 20, 20, 20)).setTo(near);
  const SE3 beside(Eigen::Quaterniond::Identity(), {-0.1, 0.0, 0.0});
  const DepthImage registered = registered_depth(image, depth_camera, beside, depth_camera);
  int hidden = 0;
  for (int y = 1; y + 1 < image.rows; ++y) {
    for (int x = 1; x + 1 < image.cols; ++x) {
      const float z = registered(y, x);
      if (z == 0.0F) {
        ++hidden;
      } else {
        EXPECT_TRUE(std::abs(z - near) < 1e-4F || std::abs(z - far) < 1e-4F) << z;
      }
    }
  }
  // The near square moves by 9.1 px, the wall by 2.9: beside the square is wall that the depth camera did not see.
  EXPECT_GT(hidden, 100);
  const int moved = static_cast<int>(std::lround(depth_camera.fx * 0.1 / near));
  EXPECT_NEAR(registered(30, 40 - moved), near, 1e-4F);
  EXPECT_EQ(registered(30, 30 - moved + 22), 0.0F);
}

TEST(RegisteredDepth, HasNothingOfWhatLiesBehindTheColourCamera) {
  const DepthImage image(depth_camera.height, depth_camera.width, 1.0F);
  const SE3 ahead(Eigen::Quaterniond::Identity(), {0.0, 0.0, -1.5});
  EXPECT_EQ(cv::countNonZero(registered_depth(image, depth_camera, ahead, color_camera)), 0);
}

TEST(RegisteredDepth, RefusesAnotherSize) {
  EXPECT_THROW(registered_depth(DepthImage(60, 79, 1.0F), depth_camera, SE3(), color_camera), InputError);
}

}  // namespace
}  // namespace odosplat
