// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <opencv2/imgproc.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/odometry/odometry.hpp"
#include "odosplat/odometry/relocalise/relocalizer.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

struct Played {
  std::vector<TrackResult> live;
  Trajectory trajectory;
  OdometryStatistics statistics;
};

class OdometryTest : public testing::Test {
 protected:
  using Path = std::function<SE3(int)>;

  /// Plays the room's images, modified by `change`, with a map that may differ from the room.
  Played play(test::BoxRoom& map, int frames, const OdometryOptions& options = {}, const SE3& start_error = {},
              const std::function<void(int, GrayImage&)>& change = {}, const Path& path = test::room_path) const {
    Played run;
    Odometry odometry(camera_, map, options, path(0) * start_error);
    for (int k = 0; k < frames; ++k) {
      GrayImage image = world_.gray(camera_, path(k));
      if (change) change(k, image);
      run.live.push_back(odometry.track(image, k / 30.0));
    }
    run.trajectory = odometry.trajectory();
    run.statistics = odometry.statistics();
    return run;
  }

  /// Root mean square position error [m] of the final trajectory.
  static double ate(const Played& run, const Path& path = test::room_path) {
    double squares = 0.0;
    for (const StampedPose& pose : run.trajectory) {
      const SE3 truth = path(static_cast<int>(std::lround(pose.time * 30.0)));
      squares += (truth.inverse() * pose.T_world_camera).translation().squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(run.trajectory.size()));
  }

  static OdometryOptions without_anchor() {
    OdometryOptions options;
    options.keyframe.anchor.enabled = false;
    return options;
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom world_;
};

TEST_F(OdometryTest, FollowsThePathToAMillimetre) {
  test::BoxRoom map;
  const Played run = play(map, 90);
  EXPECT_EQ(run.statistics.posed, 90);
  EXPECT_EQ(run.statistics.lost, 0);
  ASSERT_EQ(run.trajectory.size(), 90U);
  EXPECT_GE(run.statistics.keyframes, 4);
  EXPECT_EQ(run.statistics.anchored, run.statistics.keyframes);
  EXPECT_LT(ate(run), 0.001);
  // One rendering for each keyframe, and no other.
  EXPECT_EQ(map.renders, run.statistics.keyframes);
  for (const TrackResult& result : run.live) {
    EXPECT_EQ(result.status, TrackStatus::ok);
    EXPECT_GT(result.covariance.diagonal().minCoeff(), 0.0);
  }
}

TEST_F(OdometryTest, FollowsThePathWithoutColours) {
  test::BoxRoom map;
  map.with_color = false;
  const Played run = play(map, 90);
  EXPECT_EQ(run.statistics.posed, 90);
  EXPECT_EQ(run.statistics.anchored, 0);
  EXPECT_LT(ate(run), 0.004);
  test::BoxRoom coloured;
  EXPECT_LT(ate(play(coloured, 90, without_anchor())), 0.004);
}

TEST_F(OdometryTest, FollowsThePathOfARollingShutter) {
  // From rest, as the motion is not known at the first image, to twice the usual speed.
  const auto path = [](double k) { return test::room_path(k * k / 90.0); };
  const auto error = [&](double taken_s, double told_s) {
    Camera taken = camera_;
    taken.readout = taken_s;
    Camera told = camera_;
    told.readout = told_s;
    test::BoxRoom map;
    Odometry odometry(told, map, {}, path(0));
    for (int k = 0; k < 90; ++k) {
      odometry.track(world_.gray(taken, [&](double s) { return path(k + 30.0 * s); }), k / 30.0);
    }
    if (taken_s == told_s) {
      EXPECT_EQ(odometry.statistics().lost, 0) << taken_s;
    }
    double squares = 0.0;
    for (const StampedPose& pose : odometry.trajectory()) {
      squares += (path(pose.time * 30.0).inverse() * pose.T_world_camera).translation().squaredNorm();
    }
    return std::sqrt(squares / static_cast<double>(odometry.trajectory().size()));
  };
  for (const double readout : {0.02, -0.02}) {
    const double told = error(readout, readout);
    EXPECT_LT(told, 0.002) << readout;
    EXPECT_GT(error(readout, 0.0), 5.0 * told) << readout;
  }
}

TEST_F(OdometryTest, EveryUseOfTheMapsDepthFollowsThePath) {
  for (const DepthUse use :
       {DepthUse::fixed, DepthUse::prior, DepthUse::pose_aware_prior, DepthUse::free, DepthUse::interval}) {
    test::BoxRoom map;
    OdometryOptions options;
    options.keyframe.window_points.depth_use = use;
    const Played run = play(map, 60, options);
    EXPECT_EQ(run.statistics.lost, 0) << to_string(use);
    EXPECT_LT(ate(run), 0.002) << to_string(use);
  }
}

TEST_F(OdometryTest, GoesOnBeyondTheMapAndComesBackIntoIt) {
  // The map contains the room's right half; the camera turns left, away from it, and back.
  const auto path = [](int k) {
    const double t = 2.0 * 3.14159265 * k / 200.0;
    return SE3(so3_exp({0.05 * std::sin(2.0 * t), -0.5 * (1.0 - std::cos(t)), 0.0}),
               {0.5 * std::sin(t), 0.15 * std::sin(2.0 * t), 0.3 * std::sin(t)});
  };
  test::BoxRoom map;
  map.mapped_from = -0.4;
  const Played run = play(map, 200, {}, {}, {}, path);
  EXPECT_EQ(run.statistics.lost, 0);
  EXPECT_TRUE(run.live.front().in_map);
  int outside = 0;
  for (int k = 0; k < 200; ++k) {
    const TrackResult& result = run.live[static_cast<std::size_t>(k)];
    outside += result.in_map ? 0 : 1;
    const double error = (path(k).inverse() * result.T_world_camera).translation().norm();
    EXPECT_LT(error, 0.06) << k;
    if (k >= 190) {
      EXPECT_TRUE(result.in_map) << k;
      EXPECT_LT(error, 0.005) << k;
    }
  }
  EXPECT_GT(outside, 30);
  // The uncertainty of the pose grows outside the map and decreases when the map is seen again.
  const auto sigma = [&run](std::size_t k) {
    return std::sqrt(run.live[k].covariance.diagonal().head<3>().maxCoeff());
  };
  EXPECT_GT(sigma(160), 2.0 * sigma(40));
  EXPECT_LT(sigma(195), sigma(40));
  EXPECT_LT(run.live[100].map_share, 0.2);
}

TEST_F(OdometryTest, WhatWasSeenOnTheWayOutHoldsTheCameraOnItsWayBack) {
  // The map shows all of the first view and nothing of the farthest. Where it shows a part, its colours are shifted by
  // one pixel.
  class Map : public test::BoxRoom {
    ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override {
      ViewImages view = test::BoxRoom::render(camera, T_world_camera, request);
      if (map_share(view) > 0.9) return view;
      const cv::Matx23d shift(1.0, 0.0, 1.0, 0.0, 1.0, 0.0);
      cv::warpAffine(view.color.clone(), view.color, shift, view.color.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      return view;
    }
  };
  const auto path = [](int k) {
    const double t = 2.0 * 3.14159265 * k / 200.0;
    return SE3(so3_exp({0.05 * std::sin(2.0 * t), -0.8 * (1.0 - std::cos(t)), 0.0}),
               {0.5 * std::sin(t), 0.15 * std::sin(2.0 * t), 0.3 * std::sin(t)});
  };
  std::map<bool, double> error;  // [m] root mean square over the keyframes of which the map shows a part
  for (const bool enabled : {true, false}) {
    Map map;
    map.mapped_from = -2.1;
    OdometryOptions options;
    options.memory.enabled = enabled;
    const Played run = play(map, 200, options, {}, {}, path);
    EXPECT_EQ(run.statistics.lost, 0);
    EXPECT_GT(run.live[0].map_share, 0.9);
    EXPECT_LT(run.live[100].map_share, 0.1);
    double squares = 0.0;
    int keyframes = 0;
    for (int k = 100; k < 200; ++k) {
      const TrackResult& result = run.live[static_cast<std::size_t>(k)];
      if (!result.keyframe || result.map_share < 0.4 || result.map_share > 0.9) continue;
      squares += (path(k).inverse() * result.T_world_camera).translation().squaredNorm();
      ++keyframes;
    }
    EXPECT_GE(keyframes, 4);
    error[enabled] = std::sqrt(squares / keyframes);
  }
  EXPECT_LT(error[true], 0.01);
  EXPECT_LT(error[true], 0.5 * error[false]);
}

TEST_F(OdometryTest, ScaleStays) {
  test::BoxRoom map;
  const Played run = play(map, 90, without_anchor());
  double estimate = 0.0;
  double truth = 0.0;
  for (std::size_t k = 15; k < run.trajectory.size(); k += 15) {
    const int i = static_cast<int>(k);
    estimate +=
        (run.trajectory[k].T_world_camera.translation() - run.trajectory[k - 15].T_world_camera.translation()).norm();
    truth += (test::room_path(i).translation() - test::room_path(i - 15).translation()).norm();
  }
  EXPECT_NEAR(estimate / truth, 1.0, 0.01);
}

TEST_F(OdometryTest, TheMapPullsAWrongStartIntoPlace) {
  test::BoxRoom map;
  const SE3 error(so3_exp({0.01, -0.01, 0.005}), {0.02, -0.01, 0.02});
  const Played anchored = play(map, 40, {}, error);
  EXPECT_LT(ate(anchored), 0.002);
  const Played free = play(map, 40, without_anchor(), error);
  EXPECT_GT(ate(free), 0.005);
}

TEST_F(OdometryTest, ARoughStartIsMendedAtOnce) {
  test::BoxRoom map;
  for (const double sign : {-1.0, 1.0}) {
    SCOPED_TRACE(sign);
    const SE3 error(so3_exp(sign * Eigen::Vector3d{0.06, -0.06, 0.02}), sign * Eigen::Vector3d{0.06, -0.05, 0.06});
    const Played run = play(map, 10, {}, error);
    EXPECT_TRUE(run.live.front().anchored);
    EXPECT_LT(ate(run), 0.002);
  }
}

TEST_F(OdometryTest, AMapInOtherColoursConfirmsNothing) {
  test::BoxRoom inverted;  // cannot be compensated by gain and offset
  inverted.gamma = -0.7;
  const Played refused = play(inverted, 20);
  EXPECT_EQ(refused.statistics.posed, 0);
  EXPECT_EQ(refused.statistics.refused, 20);
  EXPECT_TRUE(refused.trajectory.empty());
  for (const TrackResult& result : refused.live) EXPECT_EQ(result.evidence.verdict, Confirmation::contradicted);
  // Without confirmation the poses are accepted, and they are accurate because the map's depth is right.
  OdometryOptions unasked;
  unasked.confirmation.enabled = false;
  const Played run = play(inverted, 60, unasked);
  EXPECT_EQ(run.statistics.posed, 60);
  EXPECT_EQ(run.statistics.confirmed, 0);
  EXPECT_LT(ate(run), 0.004);
}

TEST_F(OdometryTest, AMapInDarkerColoursDoesNoHarm) {
  test::BoxRoom darker;
  darker.gamma = 1.6;
  EXPECT_LT(ate(play(darker, 60)), 0.004);
}

TEST_F(OdometryTest, PureRotationStaysInPlace) {
  test::BoxRoom map;
  const Path turning = [](int k) { return SE3(so3_exp({0.0, 0.01 * k, 0.002 * k}), {0.2, 0.1, -0.3}); };
  const Played run = play(map, 60, {}, {}, {}, turning);
  EXPECT_EQ(run.statistics.posed, 60);
  EXPECT_LT(ate(run, turning), 0.001);
}

TEST_F(OdometryTest, ExposureMayChange) {
  test::BoxRoom map;
  const Played run = play(map, 80, {}, {}, [](int k, GrayImage& image) {
    const float gain = k < 30 ? 1.0F : k < 55 ? 1.5F : 0.8F;
    for (float& value : image) value = std::min(1.0F, gain * value);
  });
  EXPECT_EQ(run.statistics.lost, 0);
  EXPECT_LT(ate(run), 0.002);
}

TEST_F(OdometryTest, BlackFramesAreLostAndTheRunGoesOn) {
  test::BoxRoom map;
  const auto black = [](int k, GrayImage& image) {
    if (k >= 40 && k < 55) image.setTo(0.0F);
  };
  const Played run = play(map, 90, {}, {}, black);
  for (int k = 0; k < 90; ++k) {
    const TrackResult& result = run.live[static_cast<std::size_t>(k)];
    const bool dark = k >= 40 && k < 55;
    EXPECT_EQ(result.status == TrackStatus::lost, dark) << k;
    if (dark) {
      EXPECT_EQ(result.T_world_camera.matrix(), SE3().matrix());
      EXPECT_FALSE(result.keyframe);
    }
  }
  EXPECT_EQ(run.live[55].status, TrackStatus::relocalised);
  EXPECT_TRUE(run.live[55].keyframe) << "the map must confirm what an old keyframe found";
  EXPECT_EQ(run.statistics.lost, 15);
  EXPECT_EQ(run.statistics.relocalisations, 1);
  EXPECT_EQ(run.trajectory.size(), 75U);
  EXPECT_LT(ate(run), 0.0015);
}

/// Every 30th pose of the path, as places for a relocaliser.
std::vector<SE3> path_places() {
  std::vector<SE3> places;
  for (int k = 0; k < 240; k += 30) places.push_back(test::room_path(k));
  return places;
}

TEST_F(OdometryTest, StartsWithoutAPose) {
  test::BoxRoom map;
  Relocalizer relocalizer(camera_, map, path_places());
  Odometry odometry(camera_, map, {}, relocalizer);
  EXPECT_EQ(odometry.track(GrayImage(camera_.height, camera_.width, 0.2F), 0.0).status, TrackStatus::lost);
  for (int k = 40; k < 60; ++k) {
    const TrackResult result = odometry.track(world_.gray(camera_, test::room_path(k)), k / 30.0);
    EXPECT_EQ(result.status, k == 40 ? TrackStatus::relocalised : TrackStatus::ok) << k;
    EXPECT_LT((test::room_path(k).inverse() * result.T_world_camera).translation().norm(), 0.005) << k;
  }
  EXPECT_EQ(odometry.statistics().relocalisations, 1);
  EXPECT_EQ(odometry.trajectory().size(), 20U);
}

TEST_F(OdometryTest, AWrongStartIsLookedUp) {
  test::BoxRoom map;
  for (const int away : {60, 120, 180}) {
    SCOPED_TRACE(away);
    Relocalizer relocalizer(camera_, map, path_places());
    Odometry odometry(camera_, map, {}, test::room_path(away));
    odometry.set_relocalizer(&relocalizer);
    for (int k = 0; k < 10; ++k) {
      const TrackResult result = odometry.track(world_.gray(camera_, test::room_path(k)), k / 30.0);
      EXPECT_NE(result.status, TrackStatus::lost) << k;
      EXPECT_LT((test::room_path(k).inverse() * result.T_world_camera).translation().norm(), 0.005) << k;
    }
  }
}

TEST_F(OdometryTest, AKidnappedCameraIsFoundAtOnce) {
  for (const int jump : {45, 60, 105, 150, 180}) {
    SCOPED_TRACE(jump);
    // At frame 15 the camera jumps to a place where the waves on the walls fit so well that 80 % of the points agree.
    const auto path = [jump](int k) { return test::room_path(k < 15 ? k : k + jump); };
    test::BoxRoom map;
    Relocalizer relocalizer(camera_, map, path_places());
    Odometry odometry(camera_, map, {}, path(0));
    odometry.set_relocalizer(&relocalizer);
    for (int k = 0; k < 25; ++k) {
      const TrackResult result = odometry.track(world_.gray(camera_, path(k)), k / 30.0);
      EXPECT_EQ(result.status, k == 15 ? TrackStatus::relocalised : TrackStatus::ok) << k;
      EXPECT_LT((path(k).inverse() * result.T_world_camera).translation().norm(), 0.005) << k;
    }
  }
}

TEST_F(OdometryTest, AnotherRoomIsNotFoundInTheMap) {
  test::BoxRoom other;
  other.detail = 1.7;
  test::BoxRoom map;
  Relocalizer relocalizer(camera_, map, path_places());
  Odometry odometry(camera_, map, {}, test::room_path(0));
  odometry.set_relocalizer(&relocalizer);
  for (int k = 0; k < 40; ++k) {
    const bool elsewhere = k >= 15 && k < 25;
    const TrackResult result = odometry.track((elsewhere ? other : world_).gray(camera_, test::room_path(k)), k / 30.0);
    EXPECT_EQ(result.status == TrackStatus::lost, elsewhere) << k;
  }
}

TEST_F(OdometryTest, EveryPoseOnTheWayIsConfirmed) {
  test::BoxRoom map;
  const Played run = play(map, 40);
  EXPECT_EQ(run.statistics.confirmed, 40);
  EXPECT_EQ(run.statistics.refused, 0);
  EXPECT_EQ(run.statistics.likely_cause, "");
  for (const TrackResult& result : run.live) {
    EXPECT_EQ(result.evidence.verdict, Confirmation::confirmed);
    EXPECT_TRUE(result.in_map);
  }
}

TEST_F(OdometryTest, ImagesOfAnotherRoomAreRefusedFromAGivenStart) {
  test::BoxRoom other;
  other.detail = 1.7;
  test::BoxRoom map;
  for (const bool with_relocalizer : {false, true}) {
    Relocalizer relocalizer(camera_, map, path_places());
    Odometry odometry(camera_, map, {}, test::room_path(0));
    if (with_relocalizer) odometry.set_relocalizer(&relocalizer);
    for (int k = 0; k < 10; ++k) {
      const TrackResult result = odometry.track(other.gray(camera_, test::room_path(k)), k / 30.0);
      EXPECT_EQ(result.status, TrackStatus::lost) << k;
    }
    // The right room is recognised again: by the keyframe at the start pose, or by a look-up.
    const TrackResult back = odometry.track(world_.gray(camera_, test::room_path(10)), 10 / 30.0);
    EXPECT_EQ(back.status == TrackStatus::relocalised, with_relocalizer);
    EXPECT_EQ(odometry.trajectory().size(), with_relocalizer ? 1U : 0U);
  }
}

TEST_F(OdometryTest, AStartFarOutsideTheMapIsLookedUp) {
  struct SeenFromInside : test::BoxRoom {
    ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override {
      with_depth = T_world_camera.translation().norm() < 10.0;
      return BoxRoom::render(camera, T_world_camera, request);
    }
  } map;
  Relocalizer relocalizer(camera_, map, path_places());
  Odometry odometry(camera_, map, {}, SE3(Eigen::Quaterniond::Identity(), {200.0, 0.0, 0.0}));
  odometry.set_relocalizer(&relocalizer);
  const TrackResult result = odometry.track(world_.gray(camera_, test::room_path(0)), 0.0);
  EXPECT_EQ(result.status, TrackStatus::relocalised);
  EXPECT_LT((test::room_path(0).inverse() * result.T_world_camera).translation().norm(), 0.005);
}

TEST_F(OdometryTest, AWrongCameraIsNoticed) {
  test::BoxRoom map;
  Camera told = camera_;
  told.fx *= 1.08;
  told.fy *= 1.08;
  Odometry odometry(told, map, {}, test::room_path(0));
  int named = 0;
  for (int k = 0; k < 90; ++k) {
    const SE3 truth = test::room_path(k);
    const TrackResult result = odometry.track(world_.gray(camera_, truth), k / 30.0);
    if (!odometry.statistics().likely_cause.empty()) ++named;
    if (result.status == TrackStatus::lost || named == 0) continue;
    // In front of a single wall focal length and distance cannot be separated. Once the error is known, the remaining
    // effect is contained in the covariance.
    const Vector6d error = (truth * result.T_world_camera.inverse()).log();
    EXPECT_LT(error.dot(result.covariance.ldlt().solve(error)), 22.5) << k;  // exceeded with a probability of 0.1 %
  }
  EXPECT_GT(named, 30);
  EXPECT_THAT(odometry.statistics().likely_cause, testing::HasSubstr("focal length"));
}

TEST_F(OdometryTest, AnEmptyMapLosesEveryFrameQuietly) {
  test::BoxRoom map;
  map.with_depth = false;
  const Played run = play(map, 5);
  EXPECT_EQ(run.statistics.lost, 5);
  EXPECT_TRUE(run.trajectory.empty());
}

TEST_F(OdometryTest, TheFirstSeenMapStartsTheRun) {
  // The first two images are black: the start pose is used for the first image with content.
  test::BoxRoom map;
  const Path standing = [](int k) { return test::room_path(std::max(0, k - 2)); };
  const Played run = play(
      map, 20, {}, {},
      [](int k, GrayImage& image) {
        if (k < 2) image.setTo(0.0F);
      },
      standing);
  EXPECT_EQ(run.statistics.lost, 2);
  EXPECT_LT(ate(run, standing), 0.001);
}

TEST_F(OdometryTest, SameBitsWithAnyNumberOfThreads) {
  const int before = threads();
  std::vector<Trajectory> trajectories;
  for (const int n : {1, 2}) {
    set_threads(n);
    test::BoxRoom map;
    trajectories.push_back(play(map, 40).trajectory);
  }
  set_threads(before);
  ASSERT_EQ(trajectories[0].size(), trajectories[1].size());
  for (std::size_t k = 0; k < trajectories[0].size(); ++k) {
    EXPECT_EQ(trajectories[0][k].T_world_camera.matrix(), trajectories[1][k].T_world_camera.matrix()) << k;
  }
}

TEST_F(OdometryTest, BadInputIsRefused) {
  test::BoxRoom map;
  Odometry odometry(camera_, map, {}, SE3());
  EXPECT_THROW(odometry.track(GrayImage(10, 10, 0.5F), 0.0), InputError);
  EXPECT_THROW(odometry.track(GrayImage(), 0.0), InputError);
  Camera broken = camera_;
  broken.fx = 0.0;
  EXPECT_THROW(Odometry(broken, map, {}, SE3()), InputError);
  OdometryOptions options;
  options.aligner.huber = -1.0;
  EXPECT_THROW(Odometry(camera_, map, options, SE3()), InputError);
  const SE3 nowhere(Eigen::Quaterniond::Identity(), {std::nan(""), 0.0, 0.0});
  EXPECT_THROW(Odometry(camera_, map, {}, nowhere), InputError);
}

}  // namespace
}  // namespace odosplat
