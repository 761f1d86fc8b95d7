// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "odosplat/core/random.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/splat/map_file.hpp"
#include "tests/accuracy/disturb/disturb_map.hpp"

namespace odosplat::accuracy {
namespace {

namespace fs = std::filesystem;

/// Points distributed uniformly in a cube of 4 m.
std::vector<float> cube(std::size_t n) {
  Random random(5);
  std::vector<float> positions;
  for (std::size_t i = 0; i < 3 * n; ++i) positions.push_back(static_cast<float>(random.uniform(-2.0, 2.0)));
  return positions;
}

std::size_t count(const std::vector<std::uint8_t>& marks) {
  return static_cast<std::size_t>(std::count(marks.begin(), marks.end(), 1));
}

TEST(RandomBalls, MarkTheShareInBlobs) {
  const auto positions = cube(5000);
  const auto marked = in_random_balls(positions, 0.2, 0.3, 1);
  EXPECT_GE(count(marked), 1000U);
  EXPECT_LT(count(marked), 1100U);  // at most one ball more than needed
  EXPECT_EQ(marked, in_random_balls(positions, 0.2, 0.3, 1));
  EXPECT_NE(marked, in_random_balls(positions, 0.2, 0.3, 2));
  // A marked point is in a ball whose points are all marked, so most of its near neighbours are marked.
  std::size_t near_marked = 0;
  std::size_t near = 0;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (marked[i] == 0) continue;
    for (std::size_t j = 0; j < marked.size(); ++j) {
      const float dx = positions[3 * i] - positions[3 * j];
      const float dy = positions[3 * i + 1] - positions[3 * j + 1];
      const float dz = positions[3 * i + 2] - positions[3 * j + 2];
      if (i == j || dx * dx + dy * dy + dz * dz > 0.1F * 0.1F) continue;
      ++near;
      near_marked += marked[j];
    }
  }
  ASSERT_GT(near, 50U);
  EXPECT_GT(static_cast<double>(near_marked) / static_cast<double>(near), 0.7);
}

TEST(RandomBalls, NoneAndAll) {
  const auto positions = cube(100);
  EXPECT_EQ(count(in_random_balls(positions, 0.0, 0.3, 1)), 0U);
  EXPECT_EQ(count(in_random_balls(positions, 1.0, 0.3, 1)), 100U);
  EXPECT_TRUE(in_random_balls({}, 0.5, 0.3, 1).empty());
}

TEST(MovedPieces, MoveAsAWholeByTheDistance) {
  const auto before = cube(5000);
  auto after = before;
  const MoveOptions options{2, 0.7, 0.3};
  const std::size_t moved = move_random_pieces(after, options, 4);
  std::vector<Eigen::Vector3f> steps;
  std::size_t differ = 0;
  for (std::size_t i = 0; i < before.size() / 3; ++i) {
    const Eigen::Vector3f step = Eigen::Vector3f(&after[3 * i]) - Eigen::Vector3f(&before[3 * i]);
    if (step.isZero()) continue;
    ++differ;
    EXPECT_NEAR(step.norm(), 0.3F, 1e-5F);
    const auto known = [&](const Eigen::Vector3f& s) { return (s - step).norm() < 1e-5F; };
    if (std::none_of(steps.begin(), steps.end(), known)) steps.push_back(step);
  }
  EXPECT_EQ(differ, moved);
  EXPECT_EQ(steps.size(), 2U);
  // Expected number: 5000 (0.7 / 4)^3 = 27 points per cube.
  EXPECT_GT(moved, 20U);
  EXPECT_LT(moved, 80U);
}

TEST(EditedMap, DropsWholeGaussiansAndPoints) {
  const fs::path folder = fs::temp_directory_path() / "odosplat_test_edited_map";
  fs::remove_all(folder);
  fs::create_directories(folder / "out");
  Gaussians gaussians;
  gaussians.sh_degree = 1;
  gaussians.resize(4);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = static_cast<float>(i);
    for (std::size_t c = 0; c < 3; ++c) gaussians.positions[3 * i + c] = value;
    for (std::size_t c = 0; c < 3; ++c) gaussians.log_scales[3 * i + c] = -value;
    for (std::size_t c = 0; c < 4; ++c) gaussians.rotations[4 * i + c] = value + 1.0F;
    for (std::size_t c = 0; c < 12; ++c) gaussians.sh[12 * i + c] = 0.1F * value;
    gaussians.opacity_logits[i] = value;
  }
  SigmaModel sigma;
  sigma.depth_share = 0.0123F;
  apps::MapFlags flags;
  flags.map = (folder / "map.ply").string();
  write_map(flags.map, gaussians, sigma.to_lines());
  PointCloud cloud;
  for (int i = 0; i < 4; ++i) cloud.points.push_back(Eigen::Vector3f::Constant(static_cast<float>(i)));
  flags.cloud = (folder / "cloud.ply").string();
  write_point_cloud(flags.cloud, cloud);
  const MapEdit edit = [](std::span<float> positions) {
    positions[3 * 3] += 1.0F;
    return std::vector<std::uint8_t>{0, 1, 0, 0};
  };
  double share = 0.0;
  const apps::MapFlags edited = edited_map(flags, edit, (folder / "out").string(), share);
  EXPECT_EQ(share, 0.5);
  const Gaussians left = read_map(edited.map).gaussians;
  ASSERT_EQ(left.size(), 3U);
  EXPECT_EQ(left.positions, (std::vector<float>{0, 0, 0, 2, 2, 2, 4, 3, 3}));
  EXPECT_EQ(left.opacity_logits, (std::vector<float>{0, 2, 3}));
  EXPECT_EQ(left.rotations[4], 3.0F);
  EXPECT_EQ(left.sh[12], gaussians.sh[24]);
  EXPECT_FLOAT_EQ(read_map_header(edited.map).sigma->depth_share, 0.0123F);
  const PointCloud points = read_point_cloud(edited.cloud);
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points.points[1], Eigen::Vector3f(2, 2, 2));
  EXPECT_EQ(points.points[2], Eigen::Vector3f(4, 3, 3));
  fs::remove_all(folder);
}

}  // namespace
}  // namespace odosplat::accuracy
