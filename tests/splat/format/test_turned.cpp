// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/turned.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "odosplat/splat/gaussian_view.hpp"
#include "tests/splat/format/made_map.hpp"

namespace odosplat {
namespace {

const Camera camera{64, 48, 60.0, 60.0, 31.5, 23.5};

ViewImages seen(const Gaussians& gaussians, const SE3& T_world_camera) {
  GaussianView view(compute::Context::open(), gaussians, GaussianViewOptions());
  return view.render(camera, T_world_camera, {true, true});
}

/// The images of a map from a camera are those of the moved map from the moved camera: positions, axes, sizes and the
/// directions of colours have moved together. Depth scales with the map.
void expect_same_images(const Gaussians& before, const Gaussians& after, const Similarity& T_after_before) {
  const SE3 T_world_camera(Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Eigen::Vector3d(1, 2, 3).normalized())),
                           Eigen::Vector3d(0.1, -0.2, 0.3));
  const ViewImages a = seen(before, T_world_camera);
  const ViewImages b = seen(after, T_after_before * T_world_camera);
  EXPECT_GT(cv::mean(a.alpha)[0], 0.1);
  EXPECT_LT(cv::norm(a.color, b.color, cv::NORM_INF), 2e-3);
  EXPECT_LT(cv::norm(a.alpha, b.alpha, cv::NORM_INF), 2e-3);
  const cv::Mat depth = b.depth / T_after_before.scale;
  EXPECT_LT(cv::norm(a.depth, depth, cv::NORM_INF), 2e-2);
}

TEST(Turned, HalfATurnIsARotationAndIsItsOwnInverse) {
  for (int degree = 0; degree <= 3; ++degree) {
    const Gaussians g = test::made_gaussians(degree, 60);
    for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
      Gaussians turned = g;
      turn_by_half(turned, axis);
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(static_cast<Eigen::Index>(axis));
      expect_same_images(g, turned, {1.0, SE3(Eigen::Quaterniond(Eigen::AngleAxisd(M_PI, unit)), {0, 0, 0})});
      turn_by_half(turned, axis);
      EXPECT_EQ(turned.positions, g.positions);
      EXPECT_EQ(turned.rotations, g.rotations);
      EXPECT_EQ(turned.sh, g.sh);
    }
  }
}

TEST(Turned, AMovedMapLooksTheSame) {
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.3, Eigen::Vector3d(-2, 1, 0.5).normalized()));
  for (int degree = 0; degree <= 3; ++degree) {
    const Gaussians g = test::made_gaussians(degree, 60);
    Gaussians moved = g;
    const Similarity T{2.5, SE3(turn, Eigen::Vector3d(3, -1, 0.5))};
    move_gaussians(moved, T);
    expect_same_images(g, moved, T);
  }
}

TEST(Turned, RotationsOfHarmonicsFollowEachOther) {
  const Eigen::Matrix3d a = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -1, 2).normalized()).toRotationMatrix();
  const Eigen::Matrix3d b = Eigen::AngleAxisd(2.1, Eigen::Vector3d(0, 1, 1).normalized()).toRotationMatrix();
  for (int degree = 0; degree <= 3; ++degree) {
    const Eigen::MatrixXd both = sh_rotation(degree, a) * sh_rotation(degree, b);
    EXPECT_LT((both - sh_rotation(degree, a * b)).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_TRUE((both * both.transpose()).isIdentity(1e-12));
  }
}

}  // namespace
}  // namespace odosplat
