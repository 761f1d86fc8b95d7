// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/cloud_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

const Camera camera_160{160, 120, 120.0, 120.0, 79.5, 59.5};

DepthImage plane_depth(double d, const Eigen::Vector3d& n) {
  DepthImage depth(120, 160);
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 160; ++x) {
      const double z = d / n.dot(camera_160.ray(x, y));
      depth(y, x) = z > 0.0 && z < 100.0 ? static_cast<float>(z) : 0.0F;
    }
  }
  return depth;
}

TEST(CloudBuilder, PutsPointsOnTheSurfaceInTheWorldWithColorsAndNormals) {
  const Eigen::Vector3d n = Eigen::Vector3d(0.3, -0.2, 0.9).normalized();
  const SE3 T_world_camera = SE3::exp((Vector6d() << 1.0, 2.0, -3.0, 0.3, -0.8, 0.4).finished());
  CloudBuilder builder(CloudOptions{});
  builder.add(plane_depth(2.0, n), ColorImage(120, 160, cv::Vec3f(0.25F, 0.5F, 0.75F)), camera_160, T_world_camera);
  const PointCloud cloud = builder.finish();
  EXPECT_GT(cloud.size(), 2000U);
  EXPECT_EQ(cloud.size(), builder.voxels());
  ASSERT_TRUE(cloud.has_colors());
  ASSERT_TRUE(cloud.has_normals());
  const Eigen::Vector3d towards_camera = -(T_world_camera.rotation() * n);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Eigen::Vector3d p_camera = T_world_camera.inverse() * cloud.points[i].cast<double>();
    EXPECT_NEAR(n.dot(p_camera), 2.0, 1e-5);
    EXPECT_GT(cloud.normals[i].cast<double>().dot(towards_camera), 0.99);
    EXPECT_NEAR(cloud.colors[i].z(), 0.75F, 1e-4F);
  }
}

TEST(CloudBuilder, FinalPointsHaveTheNoiseAskedForAlongTheirRays) {
  CloudOptions options;
  options.noise = 0.006;
  options.seed = 5;
  CloudBuilder noisy(options);
  options.noise = 0.0;
  CloudBuilder exact(options);
  const DepthImage depth = plane_depth(2.0, Eigen::Vector3d::UnitZ());
  for (int i = 0; i < 3; ++i) {  // several points in a voxel: noise added to the pixels would average out
    noisy.add(depth, {}, camera_160, SE3());
    exact.add(depth, {}, camera_160, SE3());
  }
  const PointCloud a = exact.finish();
  const PointCloud b = noisy.finish();
  ASSERT_EQ(a.size(), b.size());
  double along = 0.0;
  double across = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector3f d = b.points[i] - a.points[i];
    const float depth_part = d.dot(a.points[i].normalized());
    along += depth_part * depth_part;
    across += d.cross(a.points[i].normalized()).squaredNorm();
  }
  const auto count = static_cast<double>(a.size());
  EXPECT_NEAR(std::sqrt(along / count), 0.006, 0.0004);
  EXPECT_LT(std::sqrt(across / count), 0.0005);
  EXPECT_FALSE(b.has_colors());
}

TEST(CloudBuilder, SameSeedSameBitsOtherSeedOtherPoints) {
  CloudOptions options;
  options.noise = 0.01;
  PointCloud clouds[3];
  for (std::uint64_t i = 0; i < 3; ++i) {
    options.seed = i == 2 ? 8 : 7;
    CloudBuilder builder(options);
    builder.add(plane_depth(2.0, Eigen::Vector3d::UnitZ()), {}, camera_160, SE3());
    clouds[i] = builder.finish();
  }
  EXPECT_EQ(clouds[0].points, clouds[1].points);
  EXPECT_EQ(clouds[0].normals, clouds[1].normals);
  EXPECT_NE(clouds[0].points, clouds[2].points);
}

TEST(CloudBuilder, LeavesOutTheFarSideOfEdgesAndKeepsThinThings) {
  DepthImage depth(120, 160, 3.0F);
  depth.col(80) = 1.0F;  // a wire one pixel wide
  depth(60, 30) = 2.2F;  // a mixed pixel at an edge: its neighbour is nearer
  depth(60, 31) = 1.5F;
  CloudOptions options;
  options.voxel = 0.001;
  options.normal_neighbors = 0;
  CloudBuilder builder(options);
  builder.add(depth, {}, camera_160, SE3());
  int wire = 0;
  int beside_wire = 0;
  int mixed = 0;
  for (const Eigen::Vector3f& p : builder.finish().points) {
    const Eigen::Vector2d pixel = camera_160.project(p.cast<double>());
    wire += p.z() < 1.01F;
    beside_wire += p.z() > 2.9F && std::abs(pixel.x() - 80.0) < 1.5;
    mixed += std::abs(p.z() - 2.2F) < 0.01F;
  }
  EXPECT_EQ(wire, 120);
  EXPECT_EQ(beside_wire, 0);
  EXPECT_EQ(mixed, 0);
}

TEST(CloudBuilder, LeavesOutGrazingViewsAndDepthOutOfRange) {
  const double slant = 85.0 * 3.14159265358979 / 180.0;
  const Eigen::Vector3d n(0.0, std::sin(slant), std::cos(slant));
  CloudOptions options;
  options.max_depth = 4.0;
  CloudBuilder builder(options);
  const DepthImage depth = plane_depth(0.5, n);
  builder.add(depth, {}, camera_160, SE3());
  int grazing = 0;
  int kept = 0;
  for (const Eigen::Vector3f& p : builder.finish().points) {
    const Eigen::Vector3d q = p.cast<double>();
    ++kept;
    grazing += n.dot(q.normalized()) < std::cos(81.0 * 3.14159265358979 / 180.0);
    EXPECT_LT(q.z(), 4.1);
  }
  EXPECT_GT(kept, 100);
  EXPECT_EQ(grazing, 0);
}

TEST(CloudBuilder, RefusesImagesThatDoNotFit) {
  CloudBuilder builder(CloudOptions{});
  EXPECT_NO_THROW(builder.add({}, {}, camera_160, SE3()));
  EXPECT_EQ(builder.finish().size(), 0U);
  EXPECT_THROW(builder.add(DepthImage(10, 10, 1.0F), {}, camera_160, SE3()), InputError);
  EXPECT_THROW(builder.add(DepthImage(120, 160, 1.0F), ColorImage(60, 80), camera_160, SE3()), InputError);
  builder.add(DepthImage(120, 160, 1.0F), {}, camera_160, SE3());
  EXPECT_THROW(builder.add(DepthImage(120, 160, 1.0F), ColorImage(120, 160), camera_160, SE3()), InputError);
  const SE3 nowhere(Eigen::Quaterniond::Identity(), Eigen::Vector3d(std::nan(""), 0, 0));
  EXPECT_THROW(builder.add(DepthImage(120, 160, 1.0F), {}, camera_160, nowhere), InputError);
  CloudOptions options;
  options.voxel = -1.0;
  EXPECT_THROW(CloudBuilder{options}, InputError);
}

}  // namespace
}  // namespace odosplat
