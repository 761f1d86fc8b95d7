// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/relocalise/relocalizer.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "tests/odometry/box_room.hpp"

namespace odosplat {
namespace {

/// A room whose map lacks everything with x of at least `border`.
class HalfRoom : public test::BoxRoom {
 public:
  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override {
    ViewImages view = BoxRoom::render(camera, T_world_camera, request);
    for (int y = 0; y < view.depth.rows; ++y) {
      for (int x = 0; x < view.depth.cols; ++x) {
        const Eigen::Vector3d p = T_world_camera * (view.depth(y, x) * camera.ray(x, y));
        if (p.x() < border) continue;
        view.depth(y, x) = 0.0F;
        view.sigma(y, x) = 0.0F;
        view.color(y, x) = cv::Vec3f::all(0.0F);
      }
    }
    return view;
  }
  double border = 0.0;  // [m]
};

/// Two identical rooms, 100 m apart.
class TwinRooms : public test::BoxRoom {
 public:
  static SE3 other(const SE3& T_world_camera) {
    return SE3(Eigen::Quaterniond::Identity(), {100.0, 0.0, 0.0}) * T_world_camera;
  }
  ViewImages render(const Camera& camera, const SE3& T_world_camera, const ViewRequest& request) override {
    const bool far = T_world_camera.translation().x() > 50.0;
    const SE3 T_room_world(Eigen::Quaterniond::Identity(), {far ? -100.0 : 0.0, 0.0, 0.0});
    return BoxRoom::render(camera, T_room_world * T_world_camera, request);
  }
};

class RelocalizerTest : public testing::Test {
 protected:
  /// Every 30th pose of a path of 8 s.
  static std::vector<SE3> places() {
    std::vector<SE3> poses;
    for (int k = 0; k < 240; k += 30) poses.push_back(test::room_path(k));
    return poses;
  }
  static double distance(const SE3& T_a, const SE3& T_b) { return (T_a.inverse() * T_b).translation().norm(); }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
};

TEST_F(RelocalizerTest, FindsEveryViewOfItsRoom) {
  Relocalizer relocalizer(camera_, room_, places());
  EXPECT_EQ(relocalizer.prepare(), places().size());
  for (int k = 11; k < 225; k += 23) {
    const Relocalization answer = relocalizer.find(room_.gray(camera_, test::room_path(k)));
    ASSERT_TRUE(answer.found) << k << ": " << answer.reason;
    EXPECT_LT(distance(answer.T_world_camera, test::room_path(k)), 0.005) << k;
    EXPECT_LT((answer.T_world_camera.inverse() * test::room_path(k)).angle(), 0.003) << k;
    EXPECT_GT(answer.score, 0.8);
    EXPECT_GT(answer.inlier_share, 0.8);
    EXPECT_TRUE(answer.reason.empty());
  }
}

TEST_F(RelocalizerTest, SaysHowSureItIs) {
  Relocalizer relocalizer(camera_, room_, places());
  for (int k = 11; k < 225; k += 23) {
    const Relocalization answer = relocalizer.find(room_.gray(camera_, test::room_path(k)));
    ASSERT_TRUE(answer.found) << k << ": " << answer.reason;
    EXPECT_GT(answer.probability, 0.99);
    const Vector6d error = (test::room_path(k) * answer.T_world_camera.inverse()).log();
    EXPECT_LT(error.dot(answer.covariance.ldlt().solve(error)), 60.0) << k;
    const Eigen::Matrix3d of_position = answer.covariance.topLeftCorner<3, 3>();
    EXPECT_LT(of_position.trace(), 0.05 * 0.05) << k;
  }
}

// A displaced world changes the covariance as a perturbation on the left of the pose.
TEST_F(RelocalizerTest, TheCovarianceIsInTheFrameOfTheWorld) {
  TwinRooms rooms;
  std::vector<SE3> others;
  for (const SE3& place : places()) others.push_back(TwinRooms::other(place));
  const GrayImage image = room_.gray(camera_, test::room_path(40));
  const Relocalization here = Relocalizer(camera_, rooms, places()).find(image);
  const Relocalization there = Relocalizer(camera_, rooms, others).find(image);
  ASSERT_TRUE(here.found && there.found);
  const Matrix6d adjoint = TwinRooms::other(SE3()).adjoint();
  const Matrix6d expected = adjoint * here.covariance * adjoint.transpose();
  EXPECT_LT((there.covariance - expected).norm(), 0.01 * expected.norm());
  EXPECT_GT((there.covariance - here.covariance).norm(), 0.5 * expected.norm());
}

TEST_F(RelocalizerTest, ExposureDoesNotMatter) {
  Relocalizer relocalizer(camera_, room_, places());
  GrayImage image;
  room_.gray(camera_, test::room_path(40)).convertTo(image, CV_32F, 0.6, 0.1);
  const Relocalization answer = relocalizer.find(image);
  ASSERT_TRUE(answer.found) << answer.reason;
  EXPECT_LT(distance(answer.T_world_camera, test::room_path(40)), 0.005);
  EXPECT_NEAR(answer.brightness.a, std::log(0.6), 0.05);
  EXPECT_NEAR(answer.brightness.b, 0.1, 0.02);
}

TEST_F(RelocalizerTest, RefusesAnotherRoom) {
  Relocalizer relocalizer(camera_, room_, places());
  for (int k = 0; k < 240; k += 24) {
    // A mirrored room has texture of the same kind, but no place of the map.
    GrayImage image;
    cv::flip(room_.gray(camera_, test::room_path(k)), image, 1);
    const Relocalization answer = relocalizer.find(image);
    EXPECT_FALSE(answer.found) << k << " score " << answer.score;
    EXPECT_FALSE(answer.reason.empty());
    EXPECT_EQ(answer.T_world_camera.matrix(), SE3().matrix());
    EXPECT_EQ(answer.covariance, Matrix6d::Zero());
    EXPECT_LT(answer.probability, 0.99);
  }
}

TEST_F(RelocalizerTest, RefusesWhereHalfOfTheMapIsGone) {
  HalfRoom half;
  const SE3 T_world_camera = test::room_path(40);
  Relocalizer relocalizer(camera_, half, places());
  // The camera looks along z from near x = 0, so about half of its view is missing.
  EXPECT_FALSE(relocalizer.find(room_.gray(camera_, T_world_camera)).found);
  half.border = 9.0;
  Relocalizer whole(camera_, half, places());
  EXPECT_TRUE(whole.find(room_.gray(camera_, T_world_camera)).found);
}

TEST_F(RelocalizerTest, RefusesWhenTwoPlacesLookAlike) {
  TwinRooms rooms;
  std::vector<SE3> both = places();
  for (const SE3& place : places()) both.push_back(TwinRooms::other(place));
  Relocalizer relocalizer(camera_, rooms, both);
  const Relocalization answer = relocalizer.find(room_.gray(camera_, test::room_path(40)));
  EXPECT_FALSE(answer.found);
  EXPECT_EQ(answer.reason, "two places look alike");
}

TEST_F(RelocalizerTest, RefusesWhatShowsNothing) {
  Relocalizer relocalizer(camera_, room_, places());
  for (const float grey : {0.0F, 0.5F, 1.0F}) {
    const Relocalization answer = relocalizer.find(GrayImage(camera_.height, camera_.width, grey));
    EXPECT_FALSE(answer.found);
    EXPECT_EQ(answer.reason, "the image has almost no contrast");
  }
  EXPECT_EQ(room_.renders, 0) << "a blank image is not worth a look at the map";
}

TEST_F(RelocalizerTest, RefusesAnEmptyMapAndNoPlaces) {
  const GrayImage image = room_.gray(camera_, test::room_path(40));
  test::BoxRoom empty;
  empty.with_depth = false;
  Relocalizer nothing(camera_, empty, places());
  EXPECT_FALSE(nothing.find(image).found);
  test::BoxRoom colourless;
  colourless.with_color = false;
  Relocalizer grey(camera_, colourless, places());
  EXPECT_FALSE(grey.find(image).found);
  Relocalizer nowhere(camera_, room_, {});
  EXPECT_EQ(nowhere.find(image).reason, "no poses to render the map from are given");
}

TEST_F(RelocalizerTest, AKnownPoseNearbyHelps) {
  // The only place looks in another direction.
  const SE3 away = test::room_path(40) * SE3(so3_exp({0.0, 2.5, 0.0}), Eigen::Vector3d::Zero());
  Relocalizer relocalizer(camera_, room_, {away});
  const GrayImage image = room_.gray(camera_, test::room_path(40));
  EXPECT_FALSE(relocalizer.find(image).found);
  const SE3 T_world_near = test::room_path(40) * SE3(so3_exp({0.01, -0.03, 0.01}), {0.06, 0.02, -0.05});
  const Relocalization answer = relocalizer.find(image, T_world_near);
  ASSERT_TRUE(answer.found) << answer.reason;
  EXPECT_LT(distance(answer.T_world_camera, test::room_path(40)), 0.005);
  test::BoxRoom other;
  other.detail = 1.7;
  EXPECT_FALSE(relocalizer.find(other.gray(camera_, test::room_path(40)), T_world_near).found);
}

TEST_F(RelocalizerTest, SameBitsTwiceAndWithAnyNumberOfThreads) {
  const int before = threads();
  std::vector<Relocalization> answers;
  for (const int n : {1, 2, 2}) {
    set_threads(n);
    Relocalizer relocalizer(camera_, room_, places());
    answers.push_back(relocalizer.find(room_.gray(camera_, test::room_path(57))));
    answers.push_back(relocalizer.find(room_.gray(camera_, test::room_path(57))));
  }
  set_threads(before);
  for (const Relocalization& answer : answers) {
    EXPECT_TRUE(answer.found);
    EXPECT_EQ(answer.T_world_camera.matrix(), answers[0].T_world_camera.matrix());
    EXPECT_EQ(answer.score, answers[0].score);
  }
}

TEST_F(RelocalizerTest, LooksAtLargeImagesInSmall) {
  const Camera large = camera_.resized(640, 480);
  Relocalizer relocalizer(large, room_, places());
  const Relocalization answer = relocalizer.find(room_.gray(large, test::room_path(40)));
  ASSERT_TRUE(answer.found) << answer.reason;
  EXPECT_LT(distance(answer.T_world_camera, test::room_path(40)), 0.005);
}

TEST_F(RelocalizerTest, BadInputIsRefused) {
  Relocalizer relocalizer(camera_, room_, places());
  EXPECT_THROW(relocalizer.find(GrayImage(10, 10, 0.5F)), InputError);
  EXPECT_THROW(relocalizer.find(GrayImage()), InputError);
  RelocalizerOptions options;
  options.candidates = 0;
  EXPECT_THROW(Relocalizer(camera_, room_, places(), options), InputError);
  EXPECT_THROW(Relocalizer(camera_, room_, {SE3(Eigen::Quaterniond::Identity(), {std::nan(""), 0.0, 0.0})}),
               InputError);
}

}  // namespace
}  // namespace odosplat
