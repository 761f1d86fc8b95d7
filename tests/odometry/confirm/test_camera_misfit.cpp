// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/camera_misfit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "odosplat/core/error.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

class CameraMisfitTest : public testing::Test {
 protected:
  /// 320 x 240, because the effects of a wrong camera are measured in pixels.
  CameraMisfitTest() { camera_ = camera_.resized(320, 240); }

  ViewPatches patches(const SE3& T_world_view, const Camera& camera) {
    return ViewPatches(camera, {T_world_view, room_.render(camera, T_world_view, {true, false})}, 0.0, {});
  }
  /// Adds images of the true camera, with `told` as the assumed camera model, at the true poses.
  void watch(CameraMisfit& misfit, const Camera& told, int keyframes = 6) {
    for (int k = 0; k < keyframes; ++k) {
      const SE3 T_world_camera = test::room_path(30 * k);
      const FramePyramid image = build_frame_pyramid(told, room_.gray(camera_, T_world_camera), 0.0);
      effect_ = misfit.effect(misfit.add(patches(T_world_camera, told), image, T_world_camera, Vector6d::Zero()), told);
    }
  }
  test::BoxRoom room_;
  Camera camera_ = test::small_camera();
  MisfitEffect effect_;
};

TEST_F(CameraMisfitTest, SquaresTellAShiftOfThePose) {
  const SE3 T_world_camera = test::room_path(20);
  const FramePyramid image = build_frame_pyramid(camera_, room_.gray(camera_, T_world_camera), 0.0);
  const ViewPatches view = patches(T_world_camera, camera_);
  for (int axis = 0; axis < 6; ++axis) {
    Vector6d twist = Vector6d::Zero();
    twist[axis] = axis < 3 ? 0.002 : 0.001;
    const SE3 T_camera_world = SE3::exp(twist) * T_world_camera.inverse();
    const MisfitSystem system = view.misfit(image, T_camera_world, Vector6d::Zero(), {}, 0, 0.3);
    ASSERT_GT(system.patches, 100);
    const Vector6d found = system.information.topLeftCorner<6, 6>().ldlt().solve(system.vector.head<6>().eval());
    // One step reduces the error by more than half; it is not exact, as each square has a single motion.
    EXPECT_LT((found + twist).norm(), 0.5 * twist.norm()) << axis;
  }
}

TEST_F(CameraMisfitTest, SquaresTellAShiftOfTheCamera) {
  const SE3 T_world_camera = test::room_path(20);
  const FramePyramid image = build_frame_pyramid(camera_, room_.gray(camera_, T_world_camera), 0.0);
  const ViewPatches view = patches(T_world_camera, camera_);
  Vector6d velocity;
  velocity << 0.8, -0.3, 0.2, 0.2, 0.9, 0.3;
  for (int k = 0; k < CameraCorrection::size; ++k) {
    CameraCorrection::Vector wrong = CameraCorrection::Vector::Zero();
    wrong[k] = k == 3 ? 0.005 : 0.002;
    const MisfitSystem system =
        view.misfit(image, T_world_camera.inverse(), velocity, CameraCorrection::from(wrong), 0, 0.3);
    constexpr int n = CameraCorrection::size;
    const CameraCorrection::Vector found =
        system.information.bottomRightCorner<n, n>().ldlt().solve(system.vector.tail<n>().eval());
    EXPECT_LT((found + wrong).norm(), 0.3 * wrong.norm()) << k;
  }
}

TEST_F(CameraMisfitTest, ARightCameraIsLeftAlone) {
  CameraMisfit misfit({});
  watch(misfit, camera_);
  EXPECT_LT(misfit.correction().vector().norm(), 0.003);
  EXPECT_LT(effect_.meters, 0.005);
  EXPECT_EQ(effect_.sigmas, 0.0);
  EXPECT_EQ(effect_.covariance.norm(), 0.0);
  EXPECT_EQ(misfit.likely_cause(camera_), "");
}

TEST_F(CameraMisfitTest, AWrongFocalLengthIsNamed) {
  for (const double factor : {0.95, 1.05}) {
    Camera told = camera_;
    told.fx *= factor;
    told.fy *= factor;
    CameraMisfit misfit({});
    watch(misfit, told);
    EXPECT_NEAR(misfit.correction().focal, 1.0 / factor - 1.0, 0.01) << factor;
    EXPECT_THAT(misfit.likely_cause(told),
                testing::ContainsRegex(factor < 1.0 ? "focal length were .* longer" : "focal length were .* shorter"));
    EXPECT_GT(effect_.covariance.diagonal().head<3>().sum(), 1e-5);
  }
}

TEST_F(CameraMisfitTest, OneImageMakesAFarWrongFocalLengthLikely) {
  Camera told = camera_;
  told.fx *= 0.8;
  told.fy *= 0.8;
  CameraMisfit misfit({});
  watch(misfit, told, 1);
  EXPECT_GT(effect_.sigmas, 2.0);
  EXPECT_GT(effect_.meters, 0.05);
}

TEST_F(CameraMisfitTest, AWrongPrincipalPointIsNamed) {
  Camera told = camera_;
  told.cx += 8.0;
  CameraMisfit misfit({});
  watch(misfit, told);
  EXPECT_NEAR(misfit.correction().center_u * told.fx, -8.0, 1.5);
  EXPECT_THAT(misfit.likely_cause(told), testing::HasSubstr("further left"));
}

TEST_F(CameraMisfitTest, ARollingShutterIsNamed) {
  Vector6d velocity;
  velocity << 0.3, 0.1, 0.1, 0.2, 0.8, 0.1;
  for (const double readout : {0.02, -0.02}) {
    CameraMisfit misfit({});
    for (int k = 0; k < 6; ++k) {
      const SE3 T_world_camera = test::room_path(30 * k);
      Camera rolling = camera_;
      rolling.readout = readout;
      const auto path = [&](double s) { return (SE3::exp(s * velocity) * T_world_camera.inverse()).inverse(); };
      const FramePyramid image = build_frame_pyramid(camera_, room_.gray(rolling, path), 0.0);
      effect_ = misfit.effect(misfit.add(patches(T_world_camera, camera_), image, T_world_camera, velocity), camera_);
    }
    EXPECT_NEAR(misfit.correction().readout, readout, 0.002);
    EXPECT_THAT(misfit.likely_cause(camera_),
                testing::MatchesRegex(readout > 0.0 ? ".* within [12][0-9] ms \\(rolling shutter\\)"
                                                    : ".* within [12][0-9] ms, the last one first"));
    EXPECT_GT(effect_.covariance.diagonal().sum(), 0.0);
  }
}

TEST_F(CameraMisfitTest, OptionsAreChecked) {
  CameraMisfitOptions options;
  options.iterations = 0;
  EXPECT_THROW(CameraMisfit{options}, InputError);
}

}  // namespace
}  // namespace odosplat
