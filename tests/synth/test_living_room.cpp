// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/random.hpp"
#include "odosplat/synth/render/ray_caster.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/sensor/lidar.hpp"

namespace odosplat {
namespace {

const Camera camera{320, 240, 250.0, 250.0, 159.5, 119.5};

const Scene& living_room() {
  static const Scene scene = make_living_room(1);
  return scene;
}

Trajectory walk() { return hand_held_path(living_room_walk(), PathOptions{}); }

TEST(LivingRoom, IsClosedButForItsWindows) {
  Random random(1);
  int lost = 0;
  for (int k = 0; k < 20000; ++k) {
    const Eigen::Vector3f origin(3.0F, 1.3F, 1.5F);
    Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
    RayHit hit;
    if (living_room().closest({origin, d.cast<float>()}, hit)) continue;
    // Rays without a hit must leave through the wall y = 4.6 within one of the two windows.
    ASSERT_GT(d.y(), 0.0);
    const Eigen::Vector3d p = origin.cast<double>() + d * (4.6 - 1.3) / d.y();
    EXPECT_GT(p.z(), 0.85);
    EXPECT_LT(p.z(), 2.2);
    EXPECT_TRUE((p.x() > 0.9 && p.x() < 2.3) || (p.x() > 3.5 && p.x() < 4.9)) << p.transpose();
    ++lost;
  }
  EXPECT_GT(lost, 100);
  EXPECT_LT(lost, 2000);
}

TEST(LivingRoom, EverythingIsInsideItsWalls) {
  for (const SceneTriangle& t : living_room().content().triangles) {
    for (const Eigen::Vector3f& p : t.p_world) {
      ASSERT_GT(p.minCoeff(), -0.02F) << p.transpose();
      ASSERT_LT(p.x(), 6.02F);
      ASSERT_LT(p.y(), 4.6F + 0.161F);
      ASSERT_LT(p.z(), 2.602F);
    }
  }
}

TEST(LivingRoom, TheWalkKeepsClearOfThings) {
  Random random(2);
  for (const StampedPose& pose : walk()) {
    const Eigen::Vector3f eye = pose.T_world_camera.translation().cast<float>();
    for (int k = 0; k < 100; ++k) {
      Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
      RayHit hit;
      if (!living_room().closest({eye, d.normalized().cast<float>()}, hit)) continue;
      ASSERT_GT(hit.t, 0.3F) << "at " << eye.transpose();
    }
  }
}

TEST(LivingRoom, ImagesOfTheWalkAreWellExposedAndNeitherBareNorRich) {
  const Trajectory path = walk();
  double gradient_share = 0.0;
  int images = 0;
  for (std::size_t k = 0; k < path.size(); k += 24) {
    const Rendering r = render(living_room(), camera, path[k].T_world_camera);
    const GrayImage gray = to_gray(r.color);
    const double mean = cv::mean(gray)[0];
    EXPECT_GT(mean, 0.15) << "frame " << k;  // dim: brighter images would have more texture than recorded rooms
    EXPECT_LT(mean, 0.75) << "frame " << k;
    const double depth_share = static_cast<double>(cv::countNonZero(r.depth)) / static_cast<double>(r.depth.total());
    EXPECT_GT(depth_share, 0.75) << "frame " << k;
    int strong = 0;
    for (int y = 1; y < gray.rows - 1; ++y) {
      for (int x = 1; x < gray.cols - 1; ++x) {
        const float gx = 127.5F * (gray(y, x + 1) - gray(y, x - 1));
        const float gy = 127.5F * (gray(y + 1, x) - gray(y - 1, x));
        if (gx * gx + gy * gy > 64.0F) ++strong;
      }
    }
    const double share = strong / (318.0 * 238.0);
    EXPECT_GT(share, 0.05) << "frame " << k;
    gradient_share += share;
    ++images;
  }
  EXPECT_LT(gradient_share / images, 0.16);
}

TEST(LivingRoom, ScansCoverWhatTheWalkSees) {
  LidarOptions options;
  options.rings = 90;
  options.columns = 360;
  const PointCloud cloud = simulate_lidar(living_room(), living_room_scan_poses(), options);
  EXPECT_GT(cloud.size(), 80000U);
  EXPECT_TRUE(cloud.has_colors());
  for (const Eigen::Vector3f& p : cloud.points) {
    ASSERT_GT(p.minCoeff(), -0.06F);
    ASSERT_LT(p.z(), 2.66F);
  }
}

}  // namespace
}  // namespace odosplat
