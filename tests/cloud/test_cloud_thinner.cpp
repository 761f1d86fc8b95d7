// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/cloud_thinner.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"

namespace odosplat {
namespace {

CloudBatch random_batch(int n, std::uint64_t seed) {
  Random random(seed);
  CloudBatch batch;
  for (int i = 0; i < n; ++i) {
    batch.points.emplace_back(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    batch.colors.emplace_back(random.uniform(), random.uniform(), random.uniform());
    batch.normals.push_back(
        Eigen::Vector3d(random.normal(), random.normal(), random.normal()).normalized().cast<float>());
  }
  return batch;
}

CloudBatch part_of(const CloudBatch& whole, std::size_t begin, std::size_t end) {
  CloudBatch part;
  for (std::size_t i = begin; i < end; ++i) {
    part.points.push_back(whole.points[i]);
    part.colors.push_back(whole.colors[i]);
    part.normals.push_back(whole.normals[i]);
  }
  return part;
}

TEST(CloudThinner, GivesTheMeansThatTheWholeCloudGives) {
  CloudBatch batch = random_batch(5000, 1);
  PointCloud whole;
  for (Eigen::Vector3d& p : batch.points) {
    whole.points.push_back(p.cast<float>());
    p = whole.points.back().cast<double>();
  }
  whole.colors = batch.colors;
  whole.normals = batch.normals;
  CloudThinner thinner(0.25);
  thinner.add(batch);
  const PointCloud thin = thinner.finish("c");
  const PointCloud expected = voxel_downsample(whole, 0.25);
  EXPECT_EQ(thin.points, expected.points);
  EXPECT_EQ(thin.colors, expected.colors);
  EXPECT_EQ(thin.normals, expected.normals);
  EXPECT_EQ(thinner.points(), 5000U);
  EXPECT_EQ(thinner.voxels(), thin.size());
}

TEST(CloudThinner, HowTheBatchesAreCutDoesNotMatter) {
  const CloudBatch batch = random_batch(1000, 2);
  CloudThinner once(0.2);
  once.add(batch);
  CloudThinner often(0.2);
  for (std::size_t i = 0; i < 1000; i += 8) often.add(part_of(batch, i, i + 8));
  EXPECT_EQ(once.finish("c").points, often.finish("c").points);
  EXPECT_EQ(once.finish("c").colors, often.finish("c").colors);
  EXPECT_EQ(once.finish("c").normals, often.finish("c").normals);
}

TEST(CloudThinner, OriginIsTakenOffInDoublePrecision) {
  CloudBatch batch;
  batch.points = {{5400000.125, 300.001, 1.0}, {5400000.126, 300.002, 1.0}};
  CloudThinner thinner(0.1, {5400000.0, 300.0, 0.0});
  thinner.add(batch);
  const PointCloud cloud = thinner.finish("c");
  ASSERT_EQ(cloud.size(), 1U);
  EXPECT_LT((cloud.points[0] - Eigen::Vector3f(0.1255F, 0.0015F, 1.0F)).norm(), 1e-6F);
  CloudThinner far(0.1);
  far.add(batch);
  EXPECT_THROW(far.finish("c"), InputError);
}

TEST(CloudThinner, ColoursAndNormalsAreAllOrNothing) {
  const CloudBatch full = random_batch(10, 3);
  CloudBatch bare = full;
  bare.colors.clear();
  bare.normals[3].setZero();
  CloudThinner thinner(0.5);
  thinner.add(full);
  EXPECT_TRUE(thinner.finish("c").has_colors());
  EXPECT_TRUE(thinner.finish("c").has_normals());
  thinner.add(bare);
  EXPECT_FALSE(thinner.finish("c").has_colors());
  EXPECT_FALSE(thinner.finish("c").has_normals());
}

// Voxel indices that exceed every integer type: each distinct position is a voxel, or the voxel is reported as too
// small.
TEST(CloudThinner, KeepsEveryPointOfAnyVoxel) {
  const CloudBatch batch = random_batch(1000, 4);
  for (const double voxel : {1e-9, 1e-10, 1e-15, 1e-19, 1e-30, 1e-300}) {
    CloudThinner thinner(voxel);
    thinner.add(batch);
    EXPECT_EQ(thinner.points(), 1000U) << voxel;
    EXPECT_EQ(thinner.voxels(), 1000U) << voxel;
    PointCloud cloud;
    for (const Eigen::Vector3d& point : batch.points) cloud.points.push_back(point.cast<float>());
    EXPECT_EQ(voxel_downsample(cloud, voxel).size(), 1000U) << voxel;
  }
  // Equal positions share a voxel of any size, on both sides of zero.
  CloudBatch twins;
  for (const double x : {1.0, -1.0, 0.0, -0.0, 1e9}) {
    twins.points.emplace_back(x, x, x);
    twins.points.emplace_back(x, x, x);
  }
  for (const double voxel : {1e-12, 1.0, 1e30}) {
    CloudThinner thinner(voxel);
    thinner.add(twins);
    EXPECT_EQ(thinner.points(), 10U);
    EXPECT_EQ(thinner.voxels(), voxel < 1e30 ? 4U : 2U) << voxel;
  }
}

TEST(CloudThinner, TellsAVoxelThatIsTooSmall) {
  CloudThinner thinner(1e-310);
  CloudBatch batch;
  batch.points = {{0, 0, 1e3}};
  try {
    thinner.add(batch);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "voxel: is too small: 1e-310 m for a point at 0 0 1e+03");
  }
}

TEST(CloudThinner, DropsWhatIsNotFinite) {
  CloudBatch batch;
  batch.points = {{std::nan(""), 0, 0}, {1, 0, 0}};
  CloudThinner thinner(0.5);
  thinner.add(batch);
  EXPECT_EQ(thinner.points(), 1U);
  EXPECT_EQ(thinner.finish("c").size(), 1U);
  EXPECT_EQ(CloudThinner(1.0).finish("c").size(), 0U);
  EXPECT_THROW(CloudThinner(0.0), InputError);
  EXPECT_THROW(CloudThinner(1.0, {std::nan(""), 0, 0}), InputError);
}

}  // namespace
}  // namespace odosplat
