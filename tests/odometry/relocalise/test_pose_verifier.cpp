// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/pose_verifier.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/odometry/relocalise/perspective_pose.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

class PoseVerifierTest : public testing::Test {
 protected:
  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  GrayImage here_ = room_.gray(camera_, test::room_path(0));
  DepthImage depth_ = DepthImage(camera_.height, camera_.width, 2.0F);
  PoseVerifierOptions options_;
};

TEST_F(PoseVerifierTest, GainAndOffsetDoNotCount) {
  GrayImage darker;
  here_.convertTo(darker, CV_32F, 0.5, 0.2);
  const PoseEvidence evidence = compare_with_map(darker, here_, depth_, options_);
  EXPECT_NEAR(evidence.score, 1.0, 1e-4);
  EXPECT_EQ(evidence.coverage, 1.0);
  EXPECT_TRUE(fault_of(evidence, options_).empty());
  GrayImage negative;
  here_.convertTo(negative, CV_32F, -1.0, 1.0);
  EXPECT_NEAR(compare_with_map(negative, here_, depth_, options_).score, -1.0, 1e-4);
}

TEST_F(PoseVerifierTest, AnotherViewDoesNotAgree) {
  const GrayImage elsewhere = room_.gray(camera_, test::room_path(80));
  const PoseEvidence evidence = compare_with_map(elsewhere, here_, depth_, options_);
  EXPECT_LT(evidence.score, 0.4);
  EXPECT_FALSE(fault_of(evidence, options_).empty());
}

TEST_F(PoseVerifierTest, HolesAreCoverageLost) {
  DepthImage holes = depth_.clone();
  holes.colRange(0, camera_.width / 2).setTo(0.0F);
  const PoseEvidence evidence = compare_with_map(here_, here_, holes, options_);
  EXPECT_NEAR(evidence.coverage, 0.5, 1e-9);
  EXPECT_NEAR(evidence.score, 1.0, 1e-4);
  EXPECT_NE(fault_of(evidence, options_).find("covers 50 %"), std::string::npos);
}

TEST_F(PoseVerifierTest, ABlankWallProvesNothing) {
  const GrayImage wall(camera_.height, camera_.width, 0.7F);
  const PoseEvidence evidence = compare_with_map(wall, wall, depth_, options_);
  EXPECT_EQ(evidence.blocks, 0);
  EXPECT_FALSE(fault_of(evidence, options_).empty());
}

TEST_F(PoseVerifierTest, OnlyHeldBackSquaresAreJudged) {
  GrayImage spoilt = here_.clone();
  Random random(1);
  int judged = 0;
  for (int y = 0; y < spoilt.rows; ++y) {
    for (int x = 0; x < spoilt.cols; ++x) {
      if (is_held_back(x, y, options_.block)) {
        ++judged;
      } else {
        spoilt(y, x) = static_cast<float>(random.uniform());
      }
    }
  }
  EXPECT_NEAR(static_cast<double>(judged) / static_cast<double>(spoilt.total()), 0.5, 0.05);
  EXPECT_NEAR(compare_with_map(spoilt, here_, depth_, options_).score, 1.0, 1e-4);
}

TEST_F(PoseVerifierTest, NoPointOfAHeldBackSquareIsAlignedTo) {
  TrackingReference reference;
  for (int level = 0; level < 3; ++level) {
    reference.cameras.push_back(camera_.level(level));
    auto& points = reference.levels.emplace_back();
    for (int y = 0; y < reference.cameras.back().height; ++y) {
      for (int x = 0; x < reference.cameras.back().width; ++x) {
        points.emplace_back();
        points.back().u = static_cast<float>(x);
        points.back().v = static_cast<float>(y);
      }
    }
  }
  const TrackingReference kept = without_held_back(reference, options_.block);
  ASSERT_EQ(kept.levels.size(), 3U);
  for (std::size_t level = 0; level < 3; ++level) {
    const double share =
        static_cast<double>(kept.levels[level].size()) / static_cast<double>(reference.levels[level].size());
    EXPECT_NEAR(share, 0.5, 0.05) << level;
    const double scale = std::ldexp(1.0, static_cast<int>(level));
    for (const ReferencePoint& p : kept.levels[level]) {
      EXPECT_FALSE(is_held_back((p.u + 0.5) * scale - 0.5, (p.v + 0.5) * scale - 0.5, options_.block));
    }
  }
}

TEST_F(PoseVerifierTest, BadOptionsAreRefused) {
  options_.block = 2;
  EXPECT_THROW(options_.check(), InputError);
}

class PerspectivePoseTest : public testing::Test {
 protected:
  /// Pixels of points 1 to 4 m in front of the camera; the first `wrong` pixels are random.
  std::vector<PointMatch> matches(int n, int wrong) const {
    Random random(5);
    std::vector<PointMatch> list;
    for (int k = 0; k < n; ++k) {
      const double u = random.uniform(0.0, camera_.width - 1.0);
      const double v = random.uniform(0.0, camera_.height - 1.0);
      const Eigen::Vector3d p = T_world_camera_ * (random.uniform(1.0, 4.0) * camera_.ray(u, v));
      const cv::Point2f pixel(static_cast<float>(k < wrong ? random.uniform(0.0, camera_.width) : u),
                              static_cast<float>(k < wrong ? random.uniform(0.0, camera_.height) : v));
      list.push_back({p, pixel});
    }
    return list;
  }
  Camera camera_ = test::small_camera();
  SE3 T_world_camera_ = test::room_path(33);
};

TEST_F(PerspectivePoseTest, IsExactAmongWrongMatches) {
  const auto pose = perspective_pose(camera_, matches(100, 60), {});
  ASSERT_TRUE(pose.has_value());
  EXPECT_GE(pose->inliers, 40);
  EXPECT_LT((pose->T_world_camera.inverse() * T_world_camera_).translation().norm(), 0.02);
}

TEST_F(PerspectivePoseTest, IsNoneOfWrongMatchesOrFew) {
  EXPECT_FALSE(perspective_pose(camera_, matches(40, 40), {}).has_value());
  EXPECT_FALSE(perspective_pose(camera_, matches(11, 0), {}).has_value());
  EXPECT_FALSE(perspective_pose(camera_, {}, {}).has_value());
}

}  // namespace
}  // namespace odosplat
