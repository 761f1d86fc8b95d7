// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/sensor/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/synth/scene/rooms.hpp"
#include "odosplat/synth/scene/scene_builder.hpp"

namespace odosplat {
namespace {

/// Four walls, floor and ceiling, x and y in -2..2, z in -1..1.
Scene plain_room() {
  SceneBuilder builder;
  builder.add_box({-2.0F, -2.0F, -1.0F}, {2.0F, 2.0F, 1.0F}, builder.add_plain(0.3F, 0.6F, 0.9F));
  return builder.build_unlit();
}

/// Distance of a point to the nearest of the room's six planes, measured along the beam from the origin.
double range_error(const Eigen::Vector3d& p) {
  const Eigen::Vector3d direction = p.normalized();
  double range = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double wall = axis == 2 ? 1.0 : 2.0;
    if (std::abs(direction[axis]) > 1e-9) range = std::min(range, wall / std::abs(direction[axis]));
  }
  return p.norm() - range;
}

TEST(Lidar, WithoutNoisePointsLieOnTheSurfaces) {
  LidarOptions options;
  options.range_noise = 0.0;
  options.min_incidence = 0.0;
  const PointCloud cloud = simulate_lidar(plain_room(), {SE3()}, options);
  ASSERT_EQ(cloud.size(), static_cast<std::size_t>(options.rings * options.columns));
  EXPECT_TRUE(cloud.has_colors());
  EXPECT_FALSE(cloud.has_normals());
  double worst = 0.0;
  for (const Eigen::Vector3f& p : cloud.points) worst = std::max(worst, std::abs(range_error(p.cast<double>())));
  EXPECT_LT(worst, 1e-6);
  for (const Eigen::Vector3f& c : cloud.colors) ASSERT_LT((c - Eigen::Vector3f(0.3F, 0.6F, 0.9F)).norm(), 1e-3F);
}

TEST(Lidar, NoiseIsNormalAndAlongTheBeam) {
  LidarOptions options;
  options.range_noise = 0.01;
  const PointCloud cloud = simulate_lidar(plain_room(), {SE3()}, options);
  ASSERT_GT(cloud.size(), 100000U);
  double sum = 0.0;
  double square = 0.0;
  double fourth = 0.0;
  for (const Eigen::Vector3f& p : cloud.points) {
    const double e = range_error(p.cast<double>()) / 0.01;
    sum += e;
    square += e * e;
    fourth += e * e * e * e;
  }
  const auto n = static_cast<double>(cloud.size());
  EXPECT_NEAR(sum / n, 0.0, 5.0 / std::sqrt(n));
  EXPECT_NEAR(square / n, 1.0, 5.0 * std::sqrt(2.0 / n));
  EXPECT_NEAR(fourth / n, 3.0, 5.0 * std::sqrt(96.0 / n));
}

TEST(Lidar, KeepsItsRangesAndAngles) {
  LidarOptions options;
  options.range_noise = 0.0;
  options.range_min = 1.5;
  options.range_max = 2.2;
  options.elevation_min = -0.2;
  options.elevation_max = 0.4;
  const PointCloud cloud = simulate_lidar(plain_room(), {SE3()}, options);
  ASSERT_GT(cloud.size(), 1000U);
  for (const Eigen::Vector3f& p : cloud.points) {
    EXPECT_GE(p.norm(), 1.5F - 1e-5F);
    EXPECT_LE(p.norm(), 2.2F + 1e-5F);
    const float elevation = std::asin(p.z() / p.norm());
    EXPECT_GE(elevation, -0.2F - 1e-5F);
    EXPECT_LE(elevation, 0.4F + 1e-5F);
  }
}

TEST(Lidar, GivesPointsInTheWorldFrame) {
  // The scanner moved and rotated: the points still lie on the world's walls.
  LidarOptions options;
  options.range_noise = 0.0;
  const SE3 T_world_scanner(so3_exp({0.1, -0.2, 0.7}), {0.5, -0.8, 0.2});
  const PointCloud cloud = simulate_lidar(plain_room(), {T_world_scanner}, options);
  ASSERT_GT(cloud.size(), 10000U);
  for (const Eigen::Vector3f& p : cloud.points) {
    const float to_wall = std::min({2.0F - std::abs(p.x()), 2.0F - std::abs(p.y()), 1.0F - std::abs(p.z())},
                                   [](float a, float b) { return std::abs(a) < std::abs(b); });
    ASSERT_LT(std::abs(to_wall), 1e-5F);
  }
}

TEST(Lidar, LeavesVoidsBehindThings) {
  SceneBuilder builder;
  const int plain = builder.add_plain(0.5F, 0.5F, 0.5F);
  builder.add_box({-2.0F, -2.0F, -1.0F}, {2.0F, 2.0F, 1.0F}, plain);
  builder.add_box({0.9F, -0.3F, -0.3F}, {1.1F, 0.3F, 0.3F}, plain);
  LidarOptions options;
  options.range_noise = 0.0;
  const PointCloud cloud = simulate_lidar(builder.build_unlit(), {SE3()}, options);
  int on_wall = 0;
  int in_shadow = 0;
  for (const Eigen::Vector3f& p : cloud.points) {
    if (p.x() < 1.999F) continue;
    ++on_wall;
    // The box's front at x = 0.9 occludes an area of the wall at x = 2 that is 2 / 0.9 as large.
    if (std::abs(p.y()) < 0.66F && std::abs(p.z()) < 0.66F) ++in_shadow;
  }
  EXPECT_GT(on_wall, 5000);
  EXPECT_EQ(in_shadow, 0);
}

TEST(Lidar, SameBitsForAnyNumberOfThreads) {
  const Scene scene = make_box_room(1);
  const std::vector<SE3> poses{SE3(Eigen::Quaterniond::Identity(), {1.0, 1.0, 1.2}),
                               SE3(Eigen::Quaterniond::Identity(), {3.2, 1.1, 1.4})};
  LidarOptions options;
  options.rings = 40;
  const int before = threads();
  set_threads(1);
  const PointCloud a = simulate_lidar(scene, poses, options);
  set_threads(2);
  const PointCloud b = simulate_lidar(scene, poses, options);
  set_threads(before);
  ASSERT_EQ(a.size(), b.size());
  EXPECT_TRUE(a.points == b.points);
  EXPECT_TRUE(a.colors == b.colors);
  options.seed = 2;
  EXPECT_FALSE(simulate_lidar(scene, poses, options).points == a.points);
}

TEST(Lidar, NoPoseOrNoSceneGivesAnEmptyCloud) {
  EXPECT_EQ(simulate_lidar(plain_room(), {}, {}).size(), 0U);
  EXPECT_EQ(simulate_lidar(SceneBuilder().build_unlit(), {SE3()}, {}).size(), 0U);
}

TEST(Lidar, RefusesWrongOptions) {
  LidarOptions options;
  options.range_max = 0.1;
  EXPECT_THROW(simulate_lidar(plain_room(), {SE3()}, options), InputError);
  options = {};
  options.rings = 0;
  EXPECT_THROW(simulate_lidar(plain_room(), {SE3()}, options), InputError);
  options = {};
  options.elevation_min = 1.2;
  EXPECT_THROW(simulate_lidar(plain_room(), {SE3()}, options), InputError);
}

}  // namespace
}  // namespace odosplat
