// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>

#include "box_room.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/odometry/photometric_pair.hpp"
#include "odosplat/odometry/window_points.hpp"

namespace odosplat {
namespace {

using Vector16d = Eigen::Matrix<double, 16, 1>;

class PhotometricPairTest : public testing::Test {
 protected:
  PhotometricPairTest() {
    T_world_host_ = SE3(so3_exp({0.05, -0.1, 0.02}), {0.1, -0.05, 0.2});
    T_world_target_ = T_world_host_ * SE3(so3_exp({0.01, 0.03, -0.02}), {0.08, -0.03, 0.05});
    const FramePyramid host = build_frame_pyramid(camera_, room_.gray(camera_, T_world_host_));
    const auto gradients = build_gradients(host);
    const ViewImages view = room_.render(camera_, T_world_host_, {});
    PixelSelector selector({});
    points_ = make_window_points(camera_, gradients, view, T_world_host_, 150, selector, {}, {});
    target_ = build_gradient(room_.gray(camera_, T_world_target_));
  }

  PhotometricPair pair() const { return {&points_, &target_, camera_, T_world_host_, T_world_target_, {}, {}, 1.0}; }

  /// The pair with its 16 parameters moved by x.
  PhotometricPair moved(const Vector16d& x) const {
    PhotometricPair p = pair();
    p.T_world_host = SE3::exp(x.segment<6>(0)) * p.T_world_host;
    p.host = {p.host.a + x[6], p.host.b + x[7]};
    p.T_world_target = SE3::exp(x.segment<6>(8)) * p.T_world_target;
    p.target_brightness = {p.target_brightness.a + x[14], p.target_brightness.b + x[15]};
    return p;
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  SE3 T_world_host_;
  SE3 T_world_target_;
  std::vector<WindowPoint> points_;
  GradientImage target_;
};

TEST_F(PhotometricPairTest, ResidualsVanishAtTheTruth) {
  const PairSystem system = evaluate_pair(pair(), {});
  ASSERT_GT(system.inliers, 80);
  EXPECT_EQ(system.outliers, 0);
  // Half a grey level: bilinear interpolation of the target is all that is wrong.
  EXPECT_LT(std::sqrt(system.squares / system.inliers), 0.6 / 255);
}

TEST_F(PhotometricPairTest, GradientMatchesCentralDifferences) {
  // Beside the truth, so that the gradient is large; the map's planes are the same, moved with the host's ray.
  Vector16d away;
  away << 0.004, -0.003, 0.002, 0.001, 0.002, -0.001, 0.03, 0.01, -0.002, 0.003, 0.004, -0.001, 0.001, 0.002, -0.02,
      0.02;
  PhotometricOptions options;
  options.huber = 1.0;  // purely quadratic, nothing rejected: smooth in all parameters
  options.outlier = 1.0;
  const PairSystem system = evaluate_pair(moved(away), options);
  ASSERT_EQ(system.outliers, 0);
  Vector16d numeric;
  for (int i = 0; i < 16; ++i) {
    const double h = i % 8 < 3 ? 1e-4 : i % 8 < 6 ? 5e-5 : 1e-3;
    Vector16d plus = Vector16d::Zero();
    plus[i] = h;
    Vector16d minus = -plus;
    // Perturbations of a perturbed pose compose on the left.
    const auto at = [&](const Vector16d& d) {
      PhotometricPair p = moved(away);
      p.T_world_host = SE3::exp(d.segment<6>(0)) * p.T_world_host;
      p.T_world_target = SE3::exp(d.segment<6>(8)) * p.T_world_target;
      p.host.a += d[6];
      p.host.b += d[7];
      p.target_brightness.a += d[14];
      p.target_brightness.b += d[15];
      return evaluate_pair(p, options).cost;
    };
    numeric[i] = (at(plus) - at(minus)) / (2.0 * h);
  }
  // Image gradients are central differences and geometry is taken at the pattern's centre: 3 % of the block's size.
  for (const int begin : {0, 3, 6, 8, 11, 14}) {
    const int size = begin % 8 == 6 ? 2 : 3;
    EXPECT_LT((system.g.segment(begin, size) - numeric.segment(begin, size)).norm(),
              0.03 * numeric.segment(begin, size).norm())
        << "block at " << begin << "\nanalytic " << system.g.transpose() << "\nnumeric  " << numeric.transpose();
  }
}

}  // namespace
}  // namespace odosplat
