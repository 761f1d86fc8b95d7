// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/cloud_filters.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "odosplat/cloud/local_planes.hpp"
#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

PointCloud random_cloud(int n, std::uint64_t seed) {
  Random random(seed);
  PointCloud cloud;
  for (int i = 0; i < n; ++i) {
    cloud.points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    cloud.colors.emplace_back(random.uniform(), random.uniform(), random.uniform());
  }
  return cloud;
}

PointCloud sphere(int n, double radius, double noise, std::uint64_t seed) {
  Random random(seed);
  PointCloud cloud;
  for (int i = 0; i < n; ++i) {
    Eigen::Vector3d d(random.normal(), random.normal(), random.normal());
    d.normalize();
    cloud.points.emplace_back(((radius + noise * random.normal()) * d).cast<float>());
  }
  return cloud;
}

TEST(NeighborSearch, AgreesWithBruteForce) {
  const PointCloud cloud = random_cloud(700, 1);
  const NeighborSearch search(cloud.points);
  Random random(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::Vector3f q(
        Eigen::Vector3d(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).cast<float>());
    std::vector<float> all;
    for (const Eigen::Vector3f& p : cloud.points) all.push_back((p - q).squaredNorm());
    std::sort(all.begin(), all.end());
    int indices[9];
    float distances[9];
    ASSERT_EQ(search.nearest(q, 9, indices, distances), 9);
    for (std::size_t i = 0; i < 9; ++i) {
      EXPECT_NEAR(distances[i], all[i], 1e-6);
      EXPECT_NEAR((cloud.points[static_cast<std::size_t>(indices[i])] - q).squaredNorm(), distances[i], 1e-6);
    }
  }
}

TEST(NeighborSearch, CopesWithEmptyFewAndEqualPoints) {
  int indices[4];
  float distances[4];
  const std::vector<Eigen::Vector3f> none;
  EXPECT_EQ(NeighborSearch(none).nearest(Eigen::Vector3f::Zero(), 4, indices, distances), 0);
  const std::vector<Eigen::Vector3f> two{{1, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(NeighborSearch(two).nearest(Eigen::Vector3f::Zero(), 4, indices, distances), 2);
  EXPECT_EQ(indices[0], 0);
  EXPECT_FLOAT_EQ(distances[1], 9.0F);
  const std::vector<Eigen::Vector3f> same(500, Eigen::Vector3f(1, 2, 3));
  EXPECT_EQ(NeighborSearch(same).nearest(Eigen::Vector3f::Zero(), 4, indices, distances), 4);
  EXPECT_FLOAT_EQ(distances[0], 14.0F);
}

TEST(NeighborSearch, NamesThePointThatIsNotFinite) {
  std::vector<Eigen::Vector3f> points(3, Eigen::Vector3f::Zero());
  points[1].y() = std::numeric_limits<float>::quiet_NaN();
  try {
    const NeighborSearch search(points);
    FAIL() << "no error";
  } catch (const InputError& e) {
    EXPECT_STREQ(e.what(), "cloud: point 1: is not finite");
  }
}

TEST(VoxelDownsample, GivesMeansInOrderOfFirstPoints) {
  PointCloud cloud;
  cloud.points = {{0.55F, 0.1F, 0.1F}, {-0.1F, 0.1F, 0.1F}, {0.65F, 0.3F, 0.1F}, {-0.3F, 0.3F, 0.3F}};
  cloud.colors = {{0, 0, 0}, {1, 0, 0}, {1, 0.5F, 0}, {0, 0, 1}};
  cloud.normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
  const PointCloud thin = voxel_downsample(cloud, 0.5);
  ASSERT_EQ(thin.size(), 2U);
  EXPECT_LT((thin.points[0] - Eigen::Vector3f(0.6F, 0.2F, 0.1F)).norm(), 1e-6F);
  EXPECT_LT((thin.points[1] - Eigen::Vector3f(-0.2F, 0.2F, 0.2F)).norm(), 1e-6F);
  EXPECT_LT((thin.colors[0] - Eigen::Vector3f(0.5F, 0.25F, 0.0F)).norm(), 1e-6F);
  EXPECT_LT((thin.normals[0] - Eigen::Vector3f(0, 1, 1).normalized()).norm(), 1e-6F);
}

TEST(VoxelDownsample, LeavesAtMostOnePointAVoxelAndConservesTheMean) {
  const PointCloud cloud = random_cloud(5000, 3);
  const PointCloud thin = voxel_downsample(cloud, 0.25);
  EXPECT_EQ(thin.size(), 512U);  // 8 x 8 x 8 voxels, ten points each on average, so none is empty
  std::vector<int> cells;
  for (const Eigen::Vector3f& p : thin.points) {
    const Eigen::Vector3i c = (p / 0.25F).array().floor().matrix().cast<int>();
    cells.push_back((c.x() * 64 + c.y()) * 64 + c.z());
  }
  std::sort(cells.begin(), cells.end());
  EXPECT_EQ(std::adjacent_find(cells.begin(), cells.end()), cells.end());
}

TEST(VoxelDownsample, DropsPointsThatAreNotFiniteAndRefusesBadVoxels) {
  PointCloud cloud;
  cloud.points = {{0, 0, std::numeric_limits<float>::infinity()}, {1, 2, 3}, {std::nanf(""), 0, 0}, {0, 1e30F, 0}};
  EXPECT_EQ(voxel_downsample(cloud, 0.1).size(), 2U);
  EXPECT_EQ(voxel_downsample(PointCloud{}, 0.1).size(), 0U);
  EXPECT_THROW(voxel_downsample(cloud, 0.0), InputError);
  EXPECT_THROW(voxel_downsample(cloud, std::nan("")), InputError);
}

TEST(EstimateNormals, AreThoseOfASphereTurnedToTheViewpoint) {
  PointCloud cloud = sphere(4000, 2.0, 0.0, 4);
  estimate_normals(cloud, 12, {Eigen::Vector3d::Zero()});
  ASSERT_TRUE(cloud.has_normals());
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.normals[i].norm(), 1.0F, 1e-5F);
    EXPECT_LT(cloud.normals[i].dot(cloud.points[i].normalized()), -0.995F);
  }
}

TEST(EstimateNormals, TurnToTheNearestOfSeveralViewpoints) {
  PointCloud cloud;
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 20; ++y)
      cloud.points.emplace_back(0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0.0F);
  }
  estimate_normals(cloud, 8, {{0.0, 1.0, 0.5}, {2.0, 1.0, -0.5}});
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const float x = cloud.points[i].x();
    if (std::abs(x - 1.0F) < 0.1F) continue;  // the two positions are about equally near
    EXPECT_NEAR(cloud.normals[i].z(), x < 1.0F ? 1.0F : -1.0F, 1e-3F);
  }
}

TEST(EstimateNormals, CopeWithTinyClouds) {
  for (int n = 0; n < 4; ++n) {
    PointCloud cloud;
    for (int i = 0; i < n; ++i) cloud.points.emplace_back(static_cast<float>(i), 0.0F, 1.0F);  // on a line
    estimate_normals(cloud, 5, {Eigen::Vector3d::Zero()});
    ASSERT_EQ(cloud.normals.size(), static_cast<std::size_t>(n));
    for (const Eigen::Vector3f& normal : cloud.normals) EXPECT_NEAR(normal.norm(), 1.0F, 1e-5F);
  }
  PointCloud cloud = random_cloud(10, 1);
  EXPECT_THROW(estimate_normals(cloud, 2), InputError);
}

TEST(LocalPlanes, ResidualEstimatesTheNoiseOfThePoints) {
  const PointCloud cloud = sphere(20000, 5.0, 0.01, 5);
  double squares = 0.0;
  for (const LocalPlane& plane : fit_local_planes(cloud, 16)) squares += plane.residual * plane.residual;
  EXPECT_NEAR(std::sqrt(squares / 20000.0), 0.01, 0.0015);
}

TEST(MeanNeighborDistances, AreTheSpacingOfAGrid) {
  PointCloud cloud;
  for (int x = 0; x < 30; ++x) {
    for (int y = 0; y < 30; ++y)
      cloud.points.emplace_back(0.1F * static_cast<float>(x), 0.1F * static_cast<float>(y), 0.0F);
  }
  const std::vector<float> d = mean_neighbor_distances(cloud, 4);
  EXPECT_NEAR(d[30 * 15 + 15], 0.1F, 1e-5F);
  const float corner = (0.1F + 0.1F + 0.1F * std::sqrt(2.0F) + 0.2F) / 4.0F;
  EXPECT_NEAR(d[0], corner, 1e-5F);
  PointCloud one;
  one.points.emplace_back(1.0F, 2.0F, 3.0F);
  EXPECT_THAT(mean_neighbor_distances(one, 4), testing::ElementsAre(0.0F));
}

TEST(MeanNeighborDistances, CountCopiesOfAPointAsNeighbors) {
  PointCloud cloud;
  cloud.points = {{0, 0, 0}, {0, 0, 0}, {0, 0, 1}};
  EXPECT_THAT(mean_neighbor_distances(cloud, 2), testing::ElementsAre(0.5F, 0.5F, 1.0F));
}

TEST(RemoveOutliers, DropsLonelyPointsAndKeepsTheRest) {
  PointCloud cloud = sphere(3000, 1.0, 0.002, 6);
  cloud.points.emplace_back(3.0F, 0.0F, 0.0F);
  cloud.points.emplace_back(0.0F, 0.0F, 0.0F);
  const PointCloud kept = remove_outliers(cloud, 8, 5.0);
  EXPECT_GT(kept.size(), 2970U);
  for (const Eigen::Vector3f& p : kept.points) EXPECT_NEAR(p.norm(), 1.0F, 0.02F);
}

TEST(CloudFilters, SameBitsWhateverTheThreads) {
  const PointCloud cloud = random_cloud(5000, 7);
  std::vector<PointCloud> clouds(2, cloud);
  std::vector<std::vector<float>> distances;
  const int before = threads();
  for (std::size_t i = 0; i < 2; ++i) {
    set_threads(i == 0 ? 1 : 3);
    estimate_normals(clouds[i], 10, {Eigen::Vector3d::Zero()});
    distances.push_back(mean_neighbor_distances(cloud, 6));
  }
  set_threads(before);
  EXPECT_EQ(clouds[0].normals, clouds[1].normals);
  EXPECT_EQ(distances[0], distances[1]);
}

// If the search for each of N coinciding points looks at all of them, it takes N^2 steps, which is minutes here.
TEST(MeanNeighborDistances, PointsThatCoincideAreQuick) {
  PointCloud cloud;
  cloud.points.assign(100000, Eigen::Vector3f(0.3F, -0.2F, 1.5F));
  cloud.points.emplace_back(0.3F, -0.2F, 2.5F);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<float> distances = mean_neighbor_distances(cloud, 3);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 10.0);
  EXPECT_EQ(distances.front(), 0.0F);
  EXPECT_EQ(distances.back(), 1.0F);
}

}  // namespace
}  // namespace odosplat
