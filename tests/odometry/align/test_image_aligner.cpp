// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "odosplat/core/random.hpp"
#include "odosplat/odometry/align/image_aligner.hpp"
#include "odosplat/odometry/frame/motion_model.hpp"
#include "tests/odometry/box_room.hpp"
#include "tests/odometry/window/central_differences.hpp"

namespace odosplat {
namespace {

class ImageAlignerTest : public testing::Test {
 protected:
  ImageAlignerTest() {
    host_ = build_frame_pyramid(camera_, room_.gray(camera_, T_world_host_));
    gradients_ = build_gradients(host_);
    PixelSelector selector({});
    reference_ = build_reference(host_, gradients_, room_.render(camera_, T_world_host_, {}), selector, {}, {});
  }

  FramePyramid seen_from(const SE3& T_target_host) const {
    return build_frame_pyramid(camera_, room_.gray(camera_, T_world_host_ * T_target_host.inverse()));
  }

  static void expect_pose(const Alignment& a, const SE3& truth, double metres, double radians) {
    EXPECT_TRUE(a.finished);
    const Vector6d error = (truth.inverse() * a.T_target_host).log();
    EXPECT_LT(error.head<3>().norm(), metres);
    EXPECT_LT(error.tail<3>().norm(), radians);
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  SE3 T_world_host_ = test::room_path(20);
  FramePyramid host_;
  std::vector<GradientImage> gradients_;
  TrackingReference reference_;
  ImageAligner aligner_{{}};
};

TEST_F(ImageAlignerTest, PointsOfOtherKeyframesAreEnoughToTrackBy) {
  // A reference without map depth: points projected from another keyframe, and their neighbours.
  TrackingReference projected;
  projected.cameras = host_.cameras;
  projected.levels.resize(host_.gray.size());
  std::vector<TransferredPoint> seen;
  for (int y = 8; y < camera_.height - 8; y += 4) {
    for (int x = 8; x < camera_.width - 8; x += 4) {
      const auto q = static_cast<float>(1.0 / room_.depth(camera_, T_world_host_, x, y));
      seen.push_back({static_cast<float>(x) + 0.3F, static_cast<float>(y) - 0.2F, q});
    }
  }
  add_projected_points(projected, gradients_, seen, {});
  ASSERT_GT(projected.levels.front().size(), 500U);
  const SE3 truth(so3_exp({0.01, -0.02, 0.015}), {0.03, 0.01, -0.02});
  const Alignment found = aligner_.align(projected, seen_from(truth), SE3(), {}, 9, 0);
  expect_pose(found, truth, 0.001, 0.0006);
  // Pixels already in the reference are not added again.
  const std::size_t before = projected.levels.front().size();
  add_projected_points(projected, gradients_, seen, {});
  EXPECT_EQ(projected.levels.front().size(), before);
}

TEST_F(ImageAlignerTest, ClippedPixelsDoNotPullTheGain) {
  const SE3 truth(so3_exp({0.01, -0.02, 0.015}), {0.03, 0.01, -0.02});
  const double gain = 2.0;
  GrayImage bright = room_.gray(camera_, T_world_host_ * truth.inverse());
  for (float& value : bright) value = std::min(1.0F, static_cast<float>(gain) * value);
  const int clipped = cv::countNonZero(bright >= 1.0F);
  ASSERT_GT(clipped, static_cast<int>(bright.total()) / 4);
  ASSERT_LT(clipped, static_cast<int>(bright.total()) * 3 / 4);
  const Alignment found = aligner_.align(reference_, build_frame_pyramid(camera_, bright), SE3(), {}, 9, 0);
  expect_pose(found, truth, 0.002, 0.001);
  EXPECT_NEAR(found.brightness.a, std::log(gain), 0.05);  // the difference is compensated by the offset
  EXPECT_GT(found.inlier_share, 0.95);
}

TEST_F(ImageAlignerTest, ProjectionJacobianMatchesCentralDifferences) {
  const Eigen::Vector3d p(0.3, -0.4, 1.7);
  const Eigen::MatrixXd numeric = test::central_differences(
      [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(camera_.project(SE3::exp(Vector6d(x)) * p)); },
      Eigen::VectorXd::Constant(6, 1e-6));
  EXPECT_LT((projection_jacobian(camera_, p) - numeric).norm(), 1e-6 * numeric.norm());
}

TEST_F(ImageAlignerTest, TemplateJacobiansMatchCentralDifferences) {
  ASSERT_GT(reference_.levels[0].size(), 500U);
  double error = 0.0;
  double size = 0.0;
  for (std::size_t k = 0; k < reference_.levels[0].size(); k += 7) {
    const ReferencePoint& point = reference_.levels[0][k];
    const Eigen::Vector3d p(point.x, point.y, point.z);
    EXPECT_LT((camera_.project(p) - Eigen::Vector2d(point.u, point.v)).norm(), 1e-3);
    const auto value = [&](const Eigen::VectorXd& x) {
      const Eigen::Vector2d uv = camera_.project(SE3::exp(Vector6d(x)) * p);
      return Eigen::VectorXd::Constant(1,
                                       bilinear(host_.gray[0], static_cast<float>(uv.x()), static_cast<float>(uv.y())));
    };
    // A step of about one pixel, which is the extent of the template's central differences.
    const double step = 1.0 / camera_.fx;
    const Eigen::MatrixXd numeric = test::central_differences(value, Eigen::VectorXd::Constant(6, step * 0.9));
    for (int i = 3; i < 6; ++i) {
      error += std::pow(point.jacobian[i] - numeric(0, i), 2);
      size += std::pow(numeric(0, i), 2);
    }
  }
  EXPECT_LT(std::sqrt(error), 0.12 * std::sqrt(size));
}

TEST_F(ImageAlignerTest, PointsLieOnTheWalls) {
  for (const auto& level : reference_.levels) {
    ASSERT_GT(level.size(), 100U);
    for (const ReferencePoint& point : level) {
      const Eigen::Vector3d p = T_world_host_ * Eigen::Vector3d(point.x, point.y, point.z);
      const Eigen::Vector3d to_wall = room_.half_size - p.cwiseAbs();
      // Near the room's edges a plane fitted over a few pixels cuts the corner.
      EXPECT_LT(std::abs(to_wall.minCoeff()), 0.05);
    }
  }
}

TEST_F(ImageAlignerTest, StaysWhereItIs) {
  const Alignment a = aligner_.align(reference_, host_, SE3(), {}, 5, 0);
  expect_pose(a, SE3(), 1e-6, 1e-6);
  EXPECT_NEAR(a.inlier_share, 1.0, 1e-9);
  EXPECT_NEAR(a.contrast, 1.0, 1e-6);
  EXPECT_NEAR(a.rmse, 0.0, 1e-5);
}

TEST_F(ImageAlignerTest, FindsMotionsOfManyDirections) {
  for (int k = 0; k < 12; ++k) {
    const double angle = k * 0.9;
    const Eigen::Vector3d translation = 0.05 * Eigen::Vector3d(std::cos(angle), std::sin(1.7 * angle), std::sin(angle));
    const Eigen::Vector3d turn = 0.03 * Eigen::Vector3d(std::sin(2.3 * angle), std::cos(angle), std::cos(1.1 * angle));
    const SE3 truth(so3_exp(turn), translation);
    const Alignment a = aligner_.align(reference_, seen_from(truth), SE3(), {}, 5, 0);
    SCOPED_TRACE(k);
    expect_pose(a, truth, 0.0015, 0.0008);
    EXPECT_GT(a.inlier_share, 0.95);
  }
}

TEST_F(ImageAlignerTest, APriorHoldsOnlyWhatTheImageDoesNotTell) {
  const SE3 truth(so3_exp({0.01, -0.02, 0.005}), {0.02, -0.01, 0.015});
  const FramePyramid target = seen_from(truth);
  // The information of textured walls is a thousand times that of a prior of centimetres.
  const PosePrior weak = pose_prior(SE3(), 0.02, 0.02);
  expect_pose(aligner_.align(reference_, target, SE3(), {}, 5, 0, &weak), truth, 0.0015, 0.0008);
  // If the walls show almost only noise, the pose of the prior is kept.
  Random random(4);
  GrayImage bare;
  room_.gray(camera_, T_world_host_ * truth.inverse()).convertTo(bare, CV_32F, 0.02, 0.4);
  for (float& value : bare) value += static_cast<float>(0.004 * random.normal());
  TrackingReference faint = reference_;
  for (auto& level : faint.levels) {
    for (ReferencePoint& point : level) {
      point.intensity = 0.02F * point.intensity + 0.4F;
      for (int i = 0; i < 6; ++i) point.jacobian[i] *= 0.02F;
      point.jacobian[6] = -point.intensity;
    }
  }
  const SE3 elsewhere(so3_exp({0.0, 0.02, 0.0}), {0.03, 0.0, 0.0});
  const PosePrior strong = pose_prior(elsewhere, 1e-4, 1e-4);
  const Alignment held = aligner_.align(faint, build_frame_pyramid(camera_, bare), elsewhere, {}, 5, 0, &strong);
  expect_pose(held, elsewhere, 0.001, 0.001);
  EXPECT_GE(held.information(0, 0), 1e8);
}

TEST_F(ImageAlignerTest, PureRotationMovesNothing) {
  const SE3 truth(so3_exp({0.02, -0.06, 0.03}), Eigen::Vector3d::Zero());
  expect_pose(aligner_.align(reference_, seen_from(truth), SE3(), {}, 5, 0), truth, 0.001, 0.0005);
}

TEST_F(ImageAlignerTest, FindsAffineBrightness) {
  const SE3 truth(so3_exp({0.01, 0.02, 0.0}), {0.02, 0.0, -0.02});
  FramePyramid target = seen_from(truth);
  const double a = 0.25;
  const double b = -0.06;
  for (GrayImage& gray : target.gray) {
    for (float& value : gray) value = static_cast<float>(std::exp(a) * value + b);
  }
  const Alignment alignment = aligner_.align(reference_, target, SE3(), {}, 5, 0);
  expect_pose(alignment, truth, 0.0015, 0.0008);
  EXPECT_NEAR(alignment.brightness.a, a, 0.01);
  EXPECT_NEAR(alignment.brightness.b, b, 0.01);
}

TEST_F(ImageAlignerTest, SurvivesAHandBeforeTheLens) {
  const SE3 truth(so3_exp({0.01, 0.02, 0.0}), {0.02, 0.01, -0.02});
  GrayImage image = room_.gray(camera_, T_world_host_ * truth.inverse());
  image(cv::Rect(0, 0, 45, camera_.height)).setTo(0.1F);
  const Alignment a = aligner_.align(reference_, build_frame_pyramid(camera_, image), SE3(), {}, 5, 0);
  expect_pose(a, truth, 0.003, 0.0015);
  EXPECT_LT(a.inlier_share, 0.9);
}

TEST_F(ImageAlignerTest, BlankImagesShowNoContrast) {
  for (const float grey : {0.0F, 0.5F}) {
    const GrayImage blank(camera_.height, camera_.width, grey);
    const Alignment a = aligner_.align(reference_, build_frame_pyramid(camera_, blank), SE3(), {}, 5, 0);
    EXPECT_LT(a.contrast, 0.05);
  }
}

TEST_F(ImageAlignerTest, LookingAwayIsNotFinished) {
  const SE3 away(so3_exp({0.0, 3.1, 0.0}), Eigen::Vector3d::Zero());
  EXPECT_FALSE(aligner_.align(reference_, host_, away, {}, 5, 0).finished);
  EXPECT_FALSE(aligner_.align({}, host_, SE3(), {}, 5, 0).finished);
}

TEST_F(ImageAlignerTest, InformationPredictsTheErrorOfNoise) {
  // Monte Carlo test: pose errors under white noise of the assumed size, normalised by the information matrix.
  const ImageAlignerOptions options;
  const SE3 truth(so3_exp({0.004, -0.003, 0.002}), {0.004, 0.002, -0.003});
  const GrayImage clean = room_.gray(camera_, T_world_host_ * truth.inverse());
  Random random(11);
  double sum = 0.0;
  const int runs = 30;
  for (int run = 0; run < runs; ++run) {
    GrayImage noisy = clean.clone();
    for (float& value : noisy) value += static_cast<float>(options.noise * random.normal());
    const Alignment a = aligner_.align(reference_, build_frame_pyramid(camera_, noisy), SE3(), {}, 5, 0);
    const Vector6d error = (truth.inverse() * a.T_target_host).log();
    sum += error.dot(a.information * error);
  }
  // Six degrees of freedom; weights below one and interpolation make the covariance slightly too large.
  EXPECT_GT(sum / runs, 1.0);
  EXPECT_LT(sum / runs, 12.0);
}

TEST_F(ImageAlignerTest, NoDepthGivesAnEmptyReference) {
  test::BoxRoom empty;
  empty.with_depth = false;
  PixelSelector selector({});
  EXPECT_TRUE(build_reference(host_, gradients_, empty.render(camera_, SE3(), {}), selector, {}, {}).empty());
  EXPECT_TRUE(build_reference(host_, gradients_, {}, selector, {}, {}).empty());
}

TEST(MotionModel, PredictsConstantVelocityOverGaps) {
  const SE3 step = SE3::exp((Vector6d() << 0.02, 0.01, -0.03, 0.01, 0.02, 0.0).finished());
  MotionHistory history;
  const SE3 first(so3_exp({0.2, 0.1, -0.3}), {1.0, 2.0, 3.0});
  history.add(0.0, first);
  EXPECT_LT((predict(history, 0.1).inverse() * first).log().norm(), 1e-12);
  history.add(0.1, first * step);
  EXPECT_LT(((first * step * step).inverse() * predict(history, 0.2)).log().norm(), 1e-9);
  EXPECT_LT(((first * step * step * step).inverse() * predict(history, 0.3)).log().norm(), 1e-9);
  history.stop();
  EXPECT_LT(((first * step).inverse() * predict(history, 0.2)).log().norm(), 1e-12);
}

}  // namespace
}  // namespace odosplat
