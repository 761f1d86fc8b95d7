// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/train/initialize.hpp"

namespace odosplat {
namespace {

const Eigen::Vector3f plane_normal = Eigen::Vector3f(0.3F, -0.5F, 0.8F).normalized();

/// Points every 2 cm on a slanted plane through (0, 0, 2), with noise [m] along its normal.
PointCloud plane_cloud(double noise) {
  Random random(5);
  const Eigen::Vector3f a = plane_normal.unitOrthogonal();
  const Eigen::Vector3f b = plane_normal.cross(a);
  PointCloud cloud;
  for (int y = -15; y <= 15; ++y) {
    for (int x = -15; x <= 15; ++x) {
      cloud.points.push_back(Eigen::Vector3f(0, 0, 2) +
                             0.02F * (static_cast<float>(x) * a + static_cast<float>(y) * b) +
                             static_cast<float>(noise * random.normal()) * plane_normal);
      cloud.colors.emplace_back(0.1F, 0.5F, 0.9F);
    }
  }
  return cloud;
}

Eigen::Vector3f short_axis(const Gaussians& g, std::size_t i) {
  const Eigen::Quaternionf q(g.rotations[4 * i], g.rotations[4 * i + 1], g.rotations[4 * i + 2],
                             g.rotations[4 * i + 3]);
  return q * Eigen::Vector3f::UnitZ();
}

double rms_distance(const Gaussians& g) {
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    const Eigen::Vector3f p(g.positions[3 * i], g.positions[3 * i + 1], g.positions[3 * i + 2]);
    const auto d = static_cast<double>(plane_normal.dot(p - Eigen::Vector3f(0, 0, 2)));
    sum += d * d;
  }
  return std::sqrt(sum / static_cast<double>(g.size()));
}

TEST(GaussiansFromCloud, DiscsLieFlatOnThePlane) {
  const PointCloud cloud = plane_cloud(0.0);
  InitializeOptions options;
  options.scale_factor = 1.0F;
  const Gaussians g = gaussians_from_cloud(cloud, options);
  ASSERT_EQ(g.size(), cloud.size());
  EXPECT_NO_THROW(g.check());
  for (std::size_t i = 0; i < g.size(); ++i) {
    EXPECT_GT(std::abs(short_axis(g, i).dot(plane_normal)), 0.9999F);
    EXPECT_FLOAT_EQ(g.log_scales[3 * i], g.log_scales[3 * i + 1]);
    EXPECT_NEAR(g.log_scales[3 * i + 2] - g.log_scales[3 * i], std::log(0.1F), 1e-5F);
    EXPECT_NEAR(1.0F / (1.0F + std::exp(-g.opacity_logits[i])), 0.8F, 1e-6F);
    EXPECT_NEAR(0.5F + 0.28209479F * g.sh[12 * i + 2], 0.9F, 1e-6F);
    for (std::size_t k = 3; k < 12; ++k) EXPECT_EQ(g.sh[12 * i + k], 0.0F);
  }
  // An inner point of a square grid has its three nearest neighbours one spacing away.
  const std::size_t middle = g.size() / 2;
  EXPECT_NEAR(std::exp(g.log_scales[3 * middle]), 0.02F, 1e-5F);
}

TEST(GaussiansFromCloud, SmoothingTakesOutNoise) {
  InitializeOptions options;
  options.smoothing_neighbors = 0;
  const double rough = rms_distance(gaussians_from_cloud(plane_cloud(0.004), options));
  options.smoothing_neighbors = 12;
  const double smooth = rms_distance(gaussians_from_cloud(plane_cloud(0.004), options));
  EXPECT_NEAR(rough, 0.004, 0.0004);
  EXPECT_LT(smooth, 0.6 * rough);
}

TEST(GaussiansFromCloud, SmoothingKeepsAStep) {
  // Two parallel planes 5 cm apart, next to each other: no point may be moved to the other one.
  PointCloud cloud;
  for (int y = -10; y <= 10; ++y)
    for (int x = -10; x <= 10; ++x)
      cloud.points.emplace_back(0.02F * static_cast<float>(x), 0.02F * static_cast<float>(y), x < 0 ? 2.0F : 2.05F);
  cloud.normals.assign(cloud.size(), Eigen::Vector3f::UnitZ());
  const Gaussians g = gaussians_from_cloud(cloud, {});
  for (std::size_t i = 0; i < g.size(); ++i) EXPECT_NEAR(g.positions[3 * i + 2], cloud.points[i].z(), 1e-6F);
}

TEST(GaussiansFromCloud, RandomShapeIsSeeded) {
  InitializeOptions options;
  options.shape = InitialShape::round;
  const Gaussians a = gaussians_from_cloud(plane_cloud(0.0), options);
  const Gaussians b = gaussians_from_cloud(plane_cloud(0.0), options);
  EXPECT_EQ(a.rotations, b.rotations);
  EXPECT_EQ(a.log_scales, b.log_scales);
  options.seed = 2;
  EXPECT_NE(gaussians_from_cloud(plane_cloud(0.0), options).rotations, a.rotations);
  // Rotations are uniformly distributed: the mean of the rotated z axes is near zero.
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) mean += short_axis(a, i) / static_cast<float>(a.size());
  EXPECT_LT(mean.norm(), 0.08F);
}

TEST(GaussiansFromCloud, BudgetIsKept) {
  InitializeOptions options;
  options.budget = 100;
  const Gaussians g = gaussians_from_cloud(plane_cloud(0.0), options);
  EXPECT_EQ(g.size(), 100U);
  // The thinned cloud is sparser, so its Gaussians are larger than those of the full one.
  EXPECT_GT(g.log_scales[0], gaussians_from_cloud(plane_cloud(0.0), {}).log_scales[0]);
  options.budget = 1U << 20U;
  EXPECT_EQ(gaussians_from_cloud(plane_cloud(0.0), options).size(), plane_cloud(0.0).size());
}

TEST(GaussiansFromCloud, TinyCloudsGiveFiniteGaussians) {
  for (std::size_t n : {1U, 2U, 3U}) {
    PointCloud cloud;
    cloud.points.assign(n, Eigen::Vector3f(1, 2, 3));  // all at the same place
    for (const InitialShape shape : {InitialShape::discs, InitialShape::round}) {
      InitializeOptions options;
      options.shape = shape;
      const Gaussians g = gaussians_from_cloud(cloud, options);
      ASSERT_EQ(g.size(), n);
      for (const float s : g.log_scales) EXPECT_TRUE(std::isfinite(s));
      for (const float q : g.rotations) EXPECT_TRUE(std::isfinite(q));
    }
  }
}

TEST(GaussiansFromCloud, RefusesBadInput) {
  EXPECT_THROW(gaussians_from_cloud({}, {}), InputError);
  PointCloud cloud = plane_cloud(0.0);
  cloud.points[7].y() = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(gaussians_from_cloud(cloud, {}), InputError);
  InitializeOptions options;
  options.opacity = 1.0F;
  EXPECT_THROW(gaussians_from_cloud(plane_cloud(0.0), options), InputError);
}

}  // namespace
}  // namespace odosplat
