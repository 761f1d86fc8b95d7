// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/perspective_pose.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

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
