// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/camera_fit.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/synth/motion/walk.hpp"
#include "odosplat/synth/render/ray_caster.hpp"
#include "odosplat/synth/scene/rooms.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

const Camera camera{240, 180, 190.0, 192.0, 119.0, 90.5};

struct View {
  GrayImage gray;
  DepthImage depth;
};

const Trajectory& path() {
  static const Trajectory walk = [] {
    WalkOptions options;
    options.frames = 90;
    options.fps = 20.0;
    options.length_m = 1.9;
    options.tremor_m = 0.004;
    options.tremor_deg = 0.6;
    return Walk({{{0.6, 0.6, 1.2}, {3.0, 2.2, 1.0}},
                 {{1.4, 0.7, 1.4}, {3.2, 1.5, 0.9}},
                 {{2.6, 0.9, 1.1}, {3.4, 2.8, 1.2}}},
                options)
        .trajectory();
  }();
  return walk;
}

const std::vector<View>& views() {
  static const std::vector<View> all = [] {
    const Scene room = make_box_room(3);
    std::vector<View> made;
    for (const StampedPose& pose : path()) {
      const Rendering view = render(room, camera, pose.T_world_camera);
      made.push_back({to_gray(view.color), view.depth});
    }
    return made;
  }();
  return all;
}

CameraFitInput right_input() {
  CameraFitInput input;
  input.camera = camera;
  for (const StampedPose& pose : path()) {
    input.times.push_back(pose.time);
    input.T_world_camera.emplace_back(pose.T_world_camera);
    input.has_depth.push_back(true);
  }
  input.gray = [](std::size_t i) { return views().at(i).gray; };
  input.depth = [](std::size_t i, const CameraState&) { return views().at(i).depth; };
  return input;
}

CameraFit fit(const CameraFitInput& input) {
  CameraFitOptions options;
  options.pairs = 24;
  return fit_camera(input, input.camera, options);
}

std::string text_of(const CameraFit& fit) {
  std::string text = "focal " + std::to_string(fit.state.camera.focal) + " +- " + std::to_string(fit.sigma[0]);
  for (const CameraFinding& f : fit.findings) text += "\n" + f.part + ": " + f.text;
  return text;
}

/// Only this part is found wrong; empty: none.
void expect_wrong_only(const CameraFit& fit, const std::string& part) {
  ASSERT_TRUE(fit.measured);
  for (const CameraFinding& f : fit.findings) {
    if (f.part == part) {
      EXPECT_EQ(f.right, std::optional<bool>(false)) << text_of(fit);
    } else {
      EXPECT_NE(f.right, std::optional<bool>(false)) << text_of(fit);
    }
  }
}

TEST(CameraFit, AgreesWithTheRightCamera) {
  const CameraFitInput input = right_input();
  const CameraFit found = fit(input);
  ASSERT_TRUE(found.measured) << found.reason;
  for (const CameraFinding& f : found.findings) EXPECT_EQ(f.right, std::optional<bool>(true)) << f.text;
  EXPECT_EQ(found.findings.size(), 5U);
  EXPECT_NEAR(found.focal_px(input.camera).value, camera.fx, 0.003 * camera.fx);
  EXPECT_NEAR(found.center_u_px(input.camera).value, camera.cx, 0.7);
  EXPECT_NEAR(found.depth_factor().value, 1.0, 0.004);
  EXPECT_LT(std::abs(found.state.time_offset), 0.003);
  EXPECT_LT(found.error_before_px, 0.15);
  EXPECT_LT(found.pose_error_m, 0.003);
}

TEST(CameraFit, FindsFocalLengths) {
  for (const double factor : {0.85, 0.95, 1.05, 1.15}) {
    CameraFitInput input = right_input();
    input.camera.fx *= factor;
    input.camera.fy *= factor;
    const CameraFit found = fit(input);
    expect_wrong_only(found, "focal length");
    EXPECT_NEAR(found.focal_px(input.camera).value, camera.fx, 0.004 * camera.fx) << factor << "\n" << text_of(found);
    EXPECT_LT(found.error_poses_px, 0.5 * found.error_before_px);
  }
}

TEST(CameraFit, FindsThePrincipalPoint) {
  CameraFitInput input = right_input();
  input.camera.cx += 7.0;
  input.camera.cy -= 5.0;
  const CameraFit found = fit(input);
  expect_wrong_only(found, "principal point");
  EXPECT_NEAR(found.center_u_px(input.camera).value, camera.cx, 0.8);
  EXPECT_NEAR(found.center_v_px(input.camera).value, camera.cy, 0.8);
}

TEST(CameraFit, FindsDistortion) {
  CameraFitInput input = right_input();
  CameraCorrection lens;
  lens.radial = -0.12;
  const auto place_of = [lens](int x, int y) { return camera.project(lens.ray(camera, x, y)); };
  input.gray = [place_of](std::size_t i) {
    const GrayImage& straight = views().at(i).gray;
    GrayImage distorted(straight.size());
    for (int y = 0; y < distorted.rows; ++y) {
      for (int x = 0; x < distorted.cols; ++x) {
        const Eigen::Vector2d p = place_of(x, y);
        distorted(y, x) = bilinear(straight, static_cast<float>(std::clamp(p.x(), 0.0, camera.width - 1.0)),
                                   static_cast<float>(std::clamp(p.y(), 0.0, camera.height - 1.0)));
      }
    }
    return distorted;
  };
  input.depth = [place_of](std::size_t i, const CameraState&) {
    const DepthImage& straight = views().at(i).depth;
    DepthImage distorted(straight.size(), 0.0F);
    for (int y = 0; y < distorted.rows; ++y) {
      for (int x = 0; x < distorted.cols; ++x) {
        const Eigen::Vector2d p = place_of(x, y);
        const bool inside = p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= camera.width - 1 && p.y() <= camera.height - 1;
        if (inside) distorted(y, x) = bilinear(straight, static_cast<float>(p.x()), static_cast<float>(p.y()));
      }
    }
    return distorted;
  };
  const CameraFit found = fit(input);
  expect_wrong_only(found, "distortion");
  EXPECT_NEAR(found.state.camera.radial, lens.radial, 0.02) << text_of(found);
}

TEST(CameraFit, FindsATimeOffset) {
  for (const int frames : {-1, 1}) {
    CameraFitInput input = right_input();
    const double interval = path()[1].time - path()[0].time;
    for (double& time : input.times) time += frames * interval;
    // The poses keep their times: image k is shown with the pose of another time.
    const CameraFitInput right = right_input();
    for (std::size_t i = 0; i < input.times.size(); ++i) {
      const auto other = static_cast<long>(i) + frames;
      const bool there = other >= 0 && other < static_cast<long>(input.times.size());
      input.T_world_camera[i] = there ? right.T_world_camera[static_cast<std::size_t>(other)] : std::nullopt;
    }
    const CameraFit found = fit(input);
    expect_wrong_only(found, "time offset");
    EXPECT_NEAR(found.state.time_offset, -frames * interval, 0.006) << text_of(found);
  }
}

TEST(CameraFit, FindsTheUnitOfDepth) {
  CameraFitInput input = right_input();
  input.depth = [](std::size_t i, const CameraState&) { return DepthImage(1.04F * views().at(i).depth); };
  const CameraFit found = fit(input);
  expect_wrong_only(found, "depth scale");
  EXPECT_NEAR(found.depth_factor().value, 1.0 / 1.04, 0.005);
}

TEST(CameraFit, ErrorsOfThePosesAreNoErrorsOfTheCamera) {
  CameraFitInput input = right_input();
  input.camera.fx *= 1.05;
  input.camera.fy *= 1.05;
  Random random(5);
  constexpr double meters = 0.006;
  constexpr double radians = 0.003;
  for (auto& pose : input.T_world_camera) {
    Vector6d error;
    for (int k = 0; k < 6; ++k) error[k] = (k < 3 ? meters : radians) * random.normal();
    pose = *pose * SE3::exp(error);
  }
  const CameraFit found = fit(input);
  ASSERT_TRUE(found.measured);
  EXPECT_NEAR(found.focal_px(input.camera).value, camera.fx,
              std::max(0.01 * camera.fx, 3.0 * found.focal_px(input.camera).sigma))
      << text_of(found);
  // Of two poses of a pair.
  EXPECT_NEAR(found.pose_error_m, std::sqrt(2.0) * meters, 0.5 * meters);
  EXPECT_LT(found.error_after_px, 0.3);
  EXPECT_GT(found.error_poses_px, 2.0 * found.error_after_px);
}

TEST(CameraFit, AStillCameraTellsNothing) {
  CameraFitInput input = right_input();
  for (auto& pose : input.T_world_camera) pose = input.T_world_camera.front();
  input.gray = [](std::size_t) { return views().front().gray; };
  input.depth = [](std::size_t, const CameraState&) { return views().front().depth; };
  const CameraFit found = fit(input);
  EXPECT_FALSE(found.measured);
  EXPECT_TRUE(found.findings.empty());
}

TEST(CameraFit, WhatIsHeldStaysToTheBit) {
  CameraFitInput input = right_input();
  input.camera.fx *= 1.05;
  input.camera.fy *= 1.05;
  CameraFitOptions options;
  options.pairs = 24;
  options.center = options.distortion = options.readout = options.depth_scale = options.time_offset = false;
  const CameraFit found = fit_camera(input, input.camera, options);
  ASSERT_TRUE(found.measured) << found.reason;
  EXPECT_NEAR(found.focal_px(input.camera).value, camera.fx, 0.004 * camera.fx);
  CameraState::Vector others = found.state.vector();
  others[CameraState::at_focal] = 0.0;
  EXPECT_TRUE(others.isZero(0.0)) << others.transpose();
  ASSERT_EQ(found.findings.size(), 1U);
  EXPECT_EQ(found.findings[0].part, "focal length");
}

TEST(CameraFit, ACameraThatOnlyMovesForwardLeavesThingsOpen) {
  // Straight on, without turning: a wrong focal length looks like a wrong unit of depth.
  CameraFitInput input = right_input();
  const SE3 start = path().front().T_world_camera;
  static std::vector<View> straight;
  if (straight.empty()) {
    const Scene room = make_box_room(3);
    for (int k = 0; k < 60; ++k) {
      const SE3 pose = start * SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 0.02 * k));
      const Rendering view = render(room, camera, pose);
      straight.push_back({to_gray(view.color), view.depth});
    }
  }
  input.times.resize(60);
  input.has_depth.assign(60, true);
  input.T_world_camera.clear();
  for (int k = 0; k < 60; ++k) {
    input.T_world_camera.emplace_back(start * SE3(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.0, 0.0, 0.02 * k)));
  }
  input.gray = [](std::size_t i) { return straight.at(i).gray; };
  input.depth = [](std::size_t i, const CameraState&) { return straight.at(i).depth; };
  const CameraFit found = fit(input);
  ASSERT_TRUE(found.measured) << found.reason;
  bool open = false;
  for (std::size_t k = 0; k < found.estimated.size(); ++k) {
    if (found.estimated[k] != Estimated::open) continue;
    open = true;
    EXPECT_EQ(found.state.vector()[static_cast<Eigen::Index>(k)], 0.0);
  }
  EXPECT_TRUE(open) << text_of(found);
  for (const CameraFinding& f : found.findings) EXPECT_NE(f.right, std::optional<bool>(false)) << f.text;
}

TEST(CameraFit, TakesDepthAndPosesWhereTheyAre) {
  CameraFitInput input = right_input();
  for (std::size_t i = 0; i < input.times.size(); ++i) {
    if (i % 5 != 2) input.has_depth[i] = false;
    if (i % 4 == 1) input.T_world_camera[i].reset();
  }
  input.depth = [&input](std::size_t i, const CameraState&) {
    return input.has_depth[i] ? views().at(i).depth : DepthImage();
  };
  input.camera.fx *= 1.06;
  input.camera.fy *= 1.06;
  const CameraFit found = fit(input);
  expect_wrong_only(found, "focal length");
  EXPECT_NEAR(found.focal_px(input.camera).value, camera.fx, 0.006 * camera.fx);
}

TEST(CameraFit, PosesOfAnotherPlaceAreNotMeasuredWith) {
  CameraFitInput input = right_input();
  for (auto& pose : input.T_world_camera) pose = pose->inverse();
  const CameraFit inverted = fit(input);
  EXPECT_TRUE(!inverted.measured || inverted.error_after_px > 1.0) << text_of(inverted);
}

TEST(CameraFit, SameBitsForAnyNumberOfThreads) {
  const int before = threads();
  set_threads(1);
  const CameraFit a = fit(right_input());
  set_threads(3);
  const CameraFit b = fit(right_input());
  set_threads(before);
  EXPECT_EQ(a.state.vector(), b.state.vector());
  EXPECT_EQ(a.sigma, b.sigma);
}

}  // namespace
}  // namespace odosplat
