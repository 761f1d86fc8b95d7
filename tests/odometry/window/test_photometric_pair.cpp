// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

#include "odosplat/odometry/window/photometric_pair.hpp"
#include "odosplat/odometry/window/window_points.hpp"
#include "tests/odometry/box_room.hpp"
#include "tests/odometry/window/central_differences.hpp"

namespace odosplat {
namespace {

using Vector16d = Eigen::Matrix<double, 16, 1>;

class PhotometricPairTest : public testing::Test {
 protected:
  PhotometricPairTest() {
    T_world_host_ = SE3(so3_exp({0.05, -0.1, 0.02}), {0.1, -0.05, 0.2});
    T_world_target_ = T_world_host_ * SE3(so3_exp({0.01, 0.03, -0.02}), {0.08, -0.03, 0.05});
    const FramePyramid host = build_frame_pyramid(camera_, room_.gray(camera_, T_world_host_));
    const ViewImages view = room_.render(camera_, T_world_host_, {});
    PixelSelector selector({});
    points_ = make_window_points(camera_, build_gradients(host), view, T_world_host_, 150, selector, {}, {},
                                 DepthUse::pose_aware);
    target_ = build_gradient(room_.gray(camera_, T_world_target_));
  }

  struct Pair {
    SE3 T_world_host;
    SE3 T_world_target;
    Brightness host;
    Brightness target;
  };

  /// The pair with its 16 parameters changed by x.
  static Pair moved(Pair p, const Eigen::VectorXd& x) {
    p.T_world_host = SE3::exp(x.segment<6>(0)) * p.T_world_host;
    p.host = {p.host.a + x[6], p.host.b + x[7]};
    p.T_world_target = SE3::exp(x.segment<6>(8)) * p.T_world_target;
    p.target = {p.target.a + x[14], p.target.b + x[15]};
    return p;
  }

  Pair pair() const { return {T_world_host_, T_world_target_, {}, {}}; }

  PairSystem evaluate(const Pair& pair, const PhotometricOptions& options = {},
                      std::span<DepthTerms> depth_terms = {}) const {
    const PoseEstimate host{pair.T_world_host, pair.T_world_host, false};
    const PoseEstimate target{pair.T_world_target, pair.T_world_target, false};
    const auto host_points = make_host_points(points_, {}, camera_, host);
    return evaluate_pair({points_, host_points, &target_, camera_, host, target, pair.host, pair.target, 1.0}, options,
                         depth_terms);
  }

  /// Compares the analytic gradient near the truth with differences of the cost.
  void check_gradient(PhotometricOptions options) const {
    Vector16d away;
    away << 0.004, -0.003, 0.002, 0.001, 0.002, -0.001, 0.03, 0.01, -0.002, 0.003, 0.004, -0.001, 0.001, 0.002, -0.02,
        0.02;
    options.huber = 1.0;  // quadratic cost without outliers: smooth in all parameters
    options.outlier = 1.0;
    const Pair at = moved(pair(), away);
    const PairSystem system = evaluate(at, options);
    ASSERT_EQ(system.outliers, 0);
    ASSERT_GT(system.inliers, 80);
    Eigen::VectorXd step(16);
    step << 1e-4, 1e-4, 1e-4, 5e-5, 5e-5, 5e-5, 1e-3, 1e-3, 1e-4, 1e-4, 1e-4, 5e-5, 5e-5, 5e-5, 1e-3, 1e-3;
    const Eigen::MatrixXd J = test::central_differences(
        [&](const Eigen::VectorXd& x) { return Eigen::VectorXd::Constant(1, evaluate(moved(at, x), options).cost); },
        step);
    const Vector16d numeric = J.row(0).transpose();
    // Tolerance of 3 % of each block: image gradients are central differences, and the geometry is that of the
    // pattern's centre.
    for (const int begin : {0, 3, 6, 8, 11, 14}) {
      const int size = begin % 8 == 6 ? 2 : 3;
      EXPECT_LT((system.g.segment(begin, size) - numeric.segment(begin, size)).norm(),
                0.03 * numeric.segment(begin, size).norm())
          << "block at " << begin << "\nanalytic " << system.g.transpose() << "\nnumeric  " << numeric.transpose();
    }
  }

  void fix_planes_to_host() {
    for (WindowPoint& point : points_) point.plane_in_world = false;
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  SE3 T_world_host_;
  SE3 T_world_target_;
  std::vector<WindowPoint> points_;
  GradientImage target_;
};

TEST_F(PhotometricPairTest, WhatIsClippedAsItMustBeSaysNothing) {
  const double gain = 1.6;
  const auto clip = [gain](float& value) { value = std::min(1.0F, static_cast<float>(gain) * value); };
  for (const bool clipped_host : {false, true}) {
    SCOPED_TRACE(clipped_host);
    if (clipped_host) {
      target_ = build_gradient(room_.gray(camera_, T_world_target_));
      for (WindowPoint& point : points_) std::for_each(point.intensity, point.intensity + pattern_size, clip);
    } else {
      GrayImage target = room_.gray(camera_, T_world_target_);
      std::for_each(target.begin(), target.end(), clip);
      target_ = build_gradient(target);
    }
    Pair p = pair();
    (clipped_host ? p.host : p.target).a = std::log(gain);
    const PairSystem system = evaluate(p);
    EXPECT_LE(system.outliers, 1);
    EXPECT_GT(system.inliers, 80);
    const Eigen::Matrix<double, 8, 1> step = system.H.bottomRightCorner<8, 8>().ldlt().solve(system.g.tail<8>());
    EXPECT_LT(step.head<3>().norm(), 0.002);
    EXPECT_LT(std::abs(step[6]), 0.03);
  }
}

TEST_F(PhotometricPairTest, ResidualsVanishAtTheTruth) {
  const PairSystem system = evaluate(pair());
  ASSERT_GT(system.inliers, 80);
  EXPECT_EQ(system.outliers, 0);
  // About half a grey level, due to the bilinear interpolation of the target.
  EXPECT_LT(std::sqrt(system.squares / system.inliers), 0.6 / 255);
}

TEST_F(PhotometricPairTest, GradientMatchesCentralDifferencesWithPlanesInTheWorld) { check_gradient({}); }

TEST_F(PhotometricPairTest, GradientMatchesCentralDifferencesWithPlanesOfTheHost) {
  fix_planes_to_host();
  check_gradient({});
}

TEST_F(PhotometricPairTest, DepthTermsMatchCentralDifferences) {
  // Offsets near the truth, for planes fixed in the world and for planes that move with the host.
  for (const bool in_world : {true, false}) {
    PhotometricOptions options;
    options.huber = 1.0;
    options.outlier = 1.0;
    for (WindowPoint& point : points_) {
      point.plane_in_world = in_world;
      point.estimated = true;
      point.offset = 0.01;
    }
    std::vector<DepthTerms> terms(points_.size());
    const PairSystem system = evaluate(pair(), options, terms);
    ASSERT_GT(system.inliers, 80);
    double difference = 0.0;
    double size = 0.0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!terms[i].inlier) continue;
      const Eigen::MatrixXd J = test::central_differences(
          [&](const Eigen::VectorXd& x) {
            points_[i].offset = 0.01 + x[0];
            const double cost = evaluate(pair(), options).cost;
            points_[i].offset = 0.01;
            return Eigen::VectorXd::Constant(1, cost);
          },
          Eigen::VectorXd::Constant(1, 2e-3));
      difference += std::pow(terms[i].g - J(0, 0), 2);
      size += J(0, 0) * J(0, 0);
      EXPECT_GT(terms[i].H, 0.0);
    }
    EXPECT_LT(std::sqrt(difference), 0.05 * std::sqrt(size));
    // Coupling with the keyframes: derivatives of the offsets' gradients by the keyframes' parameters.
    Eigen::VectorXd step(16);
    step << 1e-4, 1e-4, 1e-4, 5e-5, 5e-5, 5e-5, 1e-3, 1e-3, 1e-4, 1e-4, 1e-4, 5e-5, 5e-5, 5e-5, 1e-3, 1e-3;
    // The sum over all points, which averages the noise of single pixels.
    Eigen::VectorXd coupling = Eigen::VectorXd::Zero(16);
    for (const DepthTerms& t : terms) coupling += t.cross.cast<double>();
    const Eigen::MatrixXd J = test::central_differences(
        [&](const Eigen::VectorXd& x) {
          std::vector<DepthTerms> at(points_.size());
          evaluate(moved(pair(), x), options, at);
          double sum = 0.0;
          for (const DepthTerms& t : at) sum += t.g;
          return Eigen::VectorXd::Constant(1, sum);
        },
        step);
    // Gauss-Newton ignores second derivatives times residuals, which are small here.
    for (const int begin : {0, 3, 8, 11}) {
      EXPECT_LT((coupling.segment(begin, 3) - J.row(0).transpose().segment(begin, 3)).norm(),
                0.2 * J.row(0).transpose().segment(begin, 3).norm())
          << begin << " " << in_world;
    }
  }
}

TEST_F(PhotometricPairTest, DerivativesAreTakenAtTheLinearisedPoses) {
  for (WindowPoint& point : points_) point.estimated = true;
  const SE3 elsewhere = SE3::exp((Vector6d() << 0.03, -0.02, 0.01, 0.004, 0.01, -0.01).finished());
  const PoseEstimate host{T_world_host_, T_world_host_, false};
  const PoseEstimate target{T_world_target_, elsewhere * T_world_target_, true};
  const auto host_points = make_host_points(points_, {}, camera_, host);
  const PairSystem here = evaluate(pair());
  const PairSystem there =
      evaluate_pair({points_, host_points, &target_, camera_, host, target, {}, {}, 1.0}, PhotometricOptions());
  EXPECT_EQ(here.cost, there.cost);
  EXPECT_GT((here.H - there.H).norm(), 0.001 * here.H.norm());
  EXPECT_LT((here.H - there.H).norm(), 0.2 * here.H.norm());
}

TEST_F(PhotometricPairTest, HostPoseIsObservedOnlyByPlanesOfTheWorld) {
  // Both cameras are moved together: nothing changes if the planes move with the host, but the points do if the planes
  // are fixed in the world.
  const SE3 motion = SE3::exp((Vector6d() << 0.02, 0.01, -0.02, 0.005, -0.01, 0.01).finished());
  Pair together = pair();
  together.T_world_host = motion * together.T_world_host;
  together.T_world_target = motion * together.T_world_target;
  EXPECT_GT(evaluate(together).cost, 2.0 * evaluate(pair()).cost);
  fix_planes_to_host();
  EXPECT_NEAR(evaluate(together).cost, evaluate(pair()).cost, 1e-3 * evaluate(pair()).cost);
}

TEST_F(PhotometricPairTest, UncertainDepthWeighsLess) {
  const double precise = evaluate(pair()).H.block<3, 3>(8, 8).trace();
  for (WindowPoint& point : points_) point.sigma *= 50.0;
  const double vague = evaluate(pair()).H.block<3, 3>(8, 8).trace();
  EXPECT_LT(vague, 0.8 * precise);
  EXPECT_GT(vague, 0.0);
}

TEST_F(PhotometricPairTest, PointsOutOfViewCostNothing) {
  Pair behind = pair();
  behind.T_world_target = behind.T_world_target * SE3(so3_exp({0.0, 3.1, 0.0}), {0.0, 0.0, 0.0});
  const PairSystem system = evaluate(behind);
  EXPECT_EQ(system.inliers + system.outliers, 0);
  EXPECT_EQ(system.outside, static_cast<int>(points_.size()));
  EXPECT_EQ(system.cost, 0.0);
  EXPECT_EQ(system.H.norm(), 0.0);
}

}  // namespace
}  // namespace odosplat
