// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figure_view.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/viewer/small_scene.hpp"

namespace odosplat {
namespace {

std::vector<Eigen::Vector3d> corners() {
  std::vector<Eigen::Vector3d> points;
  for (const double x : {1.0, 5.0}) {
    for (const double y : {-2.0, 0.0}) {
      for (const double z : {3.0, 4.0}) points.emplace_back(x, y, z);
    }
  }
  return points;
}

TEST(EstimateUp, IsMinusTheMeanOfTheCamerasDown) {
  EXPECT_TRUE(estimate_up(circle(12)).isApprox(Eigen::Vector3d(0.0, -1.0, 0.0)));
  Trajectory tilted = circle(12);  // all pitched down by 20 degrees about their own x axis: the mean remains upright
  for (auto& pose : tilted) {
    pose.T_world_camera = pose.T_world_camera * SE3(so3_exp({-0.35, 0.0, 0.0}), Eigen::Vector3d::Zero());
  }
  EXPECT_TRUE(estimate_up(tilted).isApprox(Eigen::Vector3d(0.0, -1.0, 0.0)));
  const SE3 turn(so3_exp({0.0, 0.0, 0.7}), Eigen::Vector3d::Zero());  // 40 degrees: a world that is not levelled
  for (auto& pose : tilted) pose.T_world_camera = turn * pose.T_world_camera;
  EXPECT_LT((estimate_up(tilted) - turn.rotation() * Eigen::Vector3d(0.0, -1.0, 0.0)).norm(), 1e-9);
  EXPECT_EQ(estimate_up({}), Eigen::Vector3d::UnitZ());
}

TEST(PlanAxes, RunAlongTheWalls) {
  MapPoints room = grey_room();
  const Eigen::Quaternionf turn(Eigen::AngleAxisf(0.3F, Eigen::Vector3f::UnitY()));
  for (auto& p : room.cloud.points) p = turn * p;
  for (auto& n : room.cloud.normals) n = turn * n;
  const Eigen::Vector3d long_wall = (turn * Eigen::Vector3f::UnitX()).cast<double>();
  for (const bool with_normals : {true, false}) {
    const PlanAxes axes = plan_axes({0.0, -2.0, 0.0}, room.cloud.points,
                                    with_normals ? room.cloud.normals : std::vector<Eigen::Vector3f>{});
    EXPECT_GT(std::abs(axes.right.dot(long_wall)), with_normals ? 1.0 - 1e-6 : 0.999) << with_normals;
    EXPECT_TRUE(axes.up.isApprox(Eigen::Vector3d(0.0, -1.0, 0.0)));
    EXPECT_TRUE(axes.right.cross(axes.forward).isApprox(axes.up, 1e-9));
  }
}

TEST(FigureView, FitsThePointsIntoThePicture) {
  const PlanAxes axes = plan_axes(Eigen::Vector3d::UnitZ(), {}, {});
  for (const bool above : {true, false}) {
    for (const cv::Size size : {cv::Size(400, 300), cv::Size(300, 900)}) {
      const FigureView view =
          above ? view_from_above(axes, corners(), size, 0.1) : view_from_corner(axes, corners(), size, 0.1, 0.4, 0.7);
      double low_x = 1e9;
      double high_x = -1e9;
      double low_y = 1e9;
      double high_y = -1e9;
      for (const auto& p : corners()) {
        const auto pixel = view.project(p);
        ASSERT_TRUE(pixel);
        low_x = std::min(low_x, pixel->x());
        high_x = std::max(high_x, pixel->x());
        low_y = std::min(low_y, pixel->y());
        high_y = std::max(high_y, pixel->y());
      }
      EXPECT_GE(low_x, 0.1 * size.width - 1.0);
      EXPECT_LE(high_x, 0.9 * size.width);
      EXPECT_GE(low_y, 0.1 * size.height - 1.0);
      EXPECT_LE(high_y, 0.9 * size.height);
      const double used = std::max((high_x - low_x) / size.width, (high_y - low_y) / size.height);
      EXPECT_NEAR(used, 0.8, 1e-6);
    }
  }
}

TEST(FigureView, UpIsUpInThePicture) {
  const PlanAxes axes = plan_axes({0.0, -1.0, 0.0}, {}, {});
  const FigureView corner = view_from_corner(axes, corners(), {400, 300}, 0.1, 0.4, 0.7);
  const Eigen::Vector3d p(2.0, -1.0, 3.0);
  EXPECT_LT(corner.project(p + 0.3 * axes.up)->y(), corner.project(p)->y() - 5.0);
  EXPECT_NEAR(corner.project(p + 0.3 * axes.up)->x(), corner.project(p)->x(), 10.0);
  const FigureView above = view_from_above(axes, corners(), {400, 300}, 0.1);
  EXPECT_NEAR((*above.project(p + axes.up) - *above.project(p)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(above.project(p + axes.right)->x() - above.project(p)->x(), above.focal, 1e-6);
  EXPECT_NEAR(above.project(p + axes.forward)->y() - above.project(p)->y(), -above.focal, 1e-6);
  EXPECT_DOUBLE_EQ(above.pixels_per_metre(p), above.focal);
}

TEST(FigureView, NothingToSeeAndPointsBehind) {
  const PlanAxes axes;
  const FigureView view = view_from_corner(axes, {}, {40, 30}, 0.1, 0.4, 0.7);
  EXPECT_TRUE(view.project(Eigen::Vector3d::Zero()));
  const Eigen::Vector3d behind = view.T_world_view * Eigen::Vector3d(0.0, 0.0, -1.0);
  EXPECT_FALSE(view.project(behind));
  EXPECT_EQ(view.pixels_per_metre(behind), 0.0);
  const FigureView one = view_from_above(axes, {Eigen::Vector3d(7.0, 8.0, 9.0)}, {40, 30}, 0.1);
  EXPECT_NEAR(one.project({7.0, 8.0, 9.0})->x(), 19.5, 1e-6);
}

}  // namespace
}  // namespace odosplat
