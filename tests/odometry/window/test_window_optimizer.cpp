// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <map>

#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/odometry/keyframe/keyframe_maker.hpp"
#include "odosplat/odometry/window/marginalization.hpp"
#include "odosplat/odometry/window/window_optimizer.hpp"
#include "tests/odometry/box_room.hpp"
#include "tests/odometry/window/ceres_window.hpp"

namespace odosplat {
namespace {

class WindowOptimizerTest : public testing::Test {
 protected:
  /// n keyframes on the room's path, six frames apart, at their true poses with true depth.
  Window make_window(int n, bool anchored, DepthUse use = DepthUse::pose_aware, int points = 350) {
    KeyframeMakerOptions options;
    options.window_points.points = points;
    options.window_points.depth_use = use;
    options.anchor.enabled = anchored;
    // A fixed weight, to test the optimiser alone: the weight by the keyframe maker depends on how well view and image
    // agree.
    options.anchor.strength = 4.0;
    // The map is the room itself, so its edges are as accurate as those of an image.
    options.anchor.gradient_weight = options.window_points.gradient_weight;
    options.smoothing = 0.0;
    KeyframeMaker maker(options);
    const ImageAligner aligner({});
    Window window;
    for (int i = 0; i < n; ++i) {
      const SE3 T = test::room_path(6 * i);
      const auto pyramid = std::make_shared<FramePyramid>(build_frame_pyramid(camera_, room_.gray(camera_, T)));
      const auto made = maker.make(make_even(pyramid), build_gradients(*pyramid),
                                   {T, room_.render(camera_, T, {true, true})}, {}, aligner);
      EXPECT_NE(made.keyframe, nullptr);
      EXPECT_EQ(made.anchored, anchored);
      window.keyframes.push_back(made.keyframe);
    }
    return window;
  }

  /// Disturbs the estimated offsets by some per cent of the inverse depth.
  static void disturb_depths(Window& window) {
    Random random(9);
    for (const auto& keyframe : window.keyframes) {
      for (WindowPoint& point : keyframe->points) point.offset += random.uniform(-0.01, 0.01);
    }
  }

  /// [1/m] root mean square error of inverse depth over the points that several keyframes agree with.
  double depth_error(const Window& window) const {
    double sum = 0.0;
    int n = 0;
    for (const auto& keyframe : window.keyframes) {
      for (const WindowPoint& point : keyframe->points) {
        if (point.agreeing < 2) continue;
        const double truth = 1.0 / room_.depth(camera_, keyframe->T_world_camera, point.u, point.v);
        sum += std::pow(inverse_depth(point, camera_, keyframe->T_world_camera) - truth, 2);
        ++n;
      }
    }
    EXPECT_GT(n, 200);
    return std::sqrt(sum / std::max(1, n));
  }

  /// Disturbs the poses by some millimetres and tenths of a degree, similar to tracking errors.
  static void disturb(Window& window, std::size_t from) {
    Random random(4);
    for (std::size_t i = from; i < window.keyframes.size(); ++i) {
      Vector6d xi;
      for (int k = 0; k < 6; ++k) xi[k] = (k < 3 ? 0.006 : 0.003) * random.uniform(-1.0, 1.0);
      auto& T = window.keyframes[i]->T_world_camera;
      T = T * SE3::exp(xi);
    }
  }

  /// Largest distance [m] between corresponding poses of two windows.
  static double largest_difference(const Window& a, const Window& b) {
    double largest = 0.0;
    for (std::size_t i = 0; i < a.keyframes.size(); ++i) {
      const SE3 error = a.keyframes[i]->T_world_camera.inverse() * b.keyframes[i]->T_world_camera;
      largest = std::max(largest, error.translation().norm());
    }
    return largest;
  }

  static double largest_error(const Window& window) {
    double largest = 0.0;
    for (std::size_t i = 0; i < window.keyframes.size(); ++i) {
      const SE3 error = test::room_path(6 * static_cast<int>(i)).inverse() * window.keyframes[i]->T_world_camera;
      largest = std::max(largest, error.translation().norm());
    }
    return largest;
  }

  Camera camera_ = test::small_camera();
  test::BoxRoom room_;
  WindowOptimizer optimizer_{{}};
};

TEST_F(WindowOptimizerTest, FindsDisturbedPosesFromTheOldestWithoutAnchors) {
  Window window = make_window(5, false);
  disturb(window, 1);
  ASSERT_GT(largest_error(window), 0.003);
  optimizer_.optimize(window, camera_);
  EXPECT_LT(largest_error(window), 0.0015);
}

TEST_F(WindowOptimizerTest, PlacesFarFromTheOriginMakeNoDifference) {
  Window near = make_window(4, true);
  disturb(near, 0);
  Window far = make_window(4, true);
  disturb(far, 0);
  const Eigen::Vector3d by(800.0, -500.0, 300.0);
  for (const auto& keyframe : far.keyframes) {
    keyframe->T_world_camera = SE3(keyframe->T_world_camera.rotation(), keyframe->T_world_camera.translation() + by);
    keyframe->anchors[0].T_world_view =
        SE3(keyframe->anchors[0].T_world_view.rotation(), keyframe->anchors[0].T_world_view.translation() + by);
    for (auto* points : {&keyframe->points, &keyframe->anchors[0].points}) {
      for (WindowPoint& point : *points) point.plane_world.D += point.plane_world.N.dot(by);
    }
  }
  optimizer_.optimize(near, camera_);
  optimizer_.optimize(far, camera_);
  for (std::size_t i = 0; i < near.keyframes.size(); ++i) {
    const Eigen::Vector3d a = near.keyframes[i]->T_world_camera.translation() + by;
    EXPECT_LT((a - far.keyframes[i]->T_world_camera.translation()).norm(), 1e-6);
  }
}

TEST_F(WindowOptimizerTest, FindsBrightness) {
  Window window = make_window(3, true);
  // The middle keyframe was taken with a longer exposure.
  Keyframe& keyframe = *window.keyframes[1];
  for (cv::Vec4f& pixel : keyframe.gradient) {
    pixel[0] = 1.15F * pixel[0] + 0.02F;
    pixel[1] *= 1.15F;
    pixel[2] *= 1.15F;
  }
  for (WindowPoint& point : keyframe.points) {
    for (float& intensity : point.intensity) intensity = 1.15F * intensity + 0.02F;
  }
  disturb(window, 0);
  WindowOptimizerOptions options;
  options.max_iterations = 15;
  WindowOptimizer(options).optimize(window, camera_);
  EXPECT_LT(largest_error(window), 0.002);
  const Brightness relative = relative_brightness(keyframe.brightness, window.keyframes[0]->brightness);
  EXPECT_NEAR(relative.a, std::log(1.15), 0.01);
  EXPECT_NEAR(relative.b, 0.02, 0.01);
}

TEST_F(WindowOptimizerTest, AWrongAnchorIsOutvoted) {
  Window window = make_window(5, true);
  // One keyframe's rendered view is wrong: nearly all its points are outliers.
  for (WindowPoint& point : window.keyframes[2]->anchors[0].points) {
    for (float& intensity : point.intensity) intensity = 1.0F - intensity;
  }
  disturb(window, 0);
  optimizer_.optimize(window, camera_);
  EXPECT_LT(largest_error(window), 0.002);
}

TEST_F(WindowOptimizerTest, TwoAnchorsOfHalfTheWeightAreAsGoodAsOne) {
  Window one = make_window(4, true);
  Window two = make_window(4, true);
  for (const auto& keyframe : two.keyframes) {
    keyframe->anchors[0].weight *= 0.5;
    keyframe->anchors.push_back(keyframe->anchors[0]);
  }
  for (Window* window : {&one, &two}) {
    disturb(*window, 1);
    optimizer_.optimize(*window, camera_);
    EXPECT_LT(largest_error(*window), 0.0015);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const Keyframe& a = *one.keyframes[k];
    const Keyframe& b = *two.keyframes[k];
    EXPECT_LT((a.T_world_camera.inverse() * b.T_world_camera).log().norm(), 1e-5);
    EXPECT_NEAR(a.anchors[0].brightness.a, b.anchors[1].brightness.a, 1e-4);
  }
  for (Window* window : {&one, &two}) marginalize_keyframe(*window, 0, camera_, {}, {});
  ASSERT_EQ(one.prior.H.rows(), two.prior.H.rows());
  EXPECT_LT((one.prior.H - two.prior.H).norm(), 0.01 * one.prior.H.norm());
}

TEST_F(WindowOptimizerTest, AnAnchorsUncertaintyIsPassedOn) {
  Window window = make_window(4, true);
  optimizer_.optimize(window, camera_);
  const Matrix6d before = window.keyframes[2]->covariance;
  const Matrix6d own = 1e-4 * Matrix6d::Identity();
  for (const double share : {0.5, 1.5}) {
    Anchor anchor = window.keyframes[2]->anchors[0];
    anchor.covariance = share * own;
    window.keyframes[2]->anchors.push_back(anchor);
  }
  window.keyframes[2]->anchors.erase(window.keyframes[2]->anchors.begin());
  optimizer_.optimize(window, camera_);
  EXPECT_LT((window.keyframes[2]->covariance - before - own).norm(), 0.02 * own.norm());
}

TEST_F(WindowOptimizerTest, CovarianceIsPositiveAndSmallerWithMoreKeyframes) {
  Window two = make_window(2, true);
  Window six = make_window(6, true);
  optimizer_.optimize(two, camera_);
  optimizer_.optimize(six, camera_);
  for (const Window* window : {&two, &six}) {
    for (const auto& keyframe : window->keyframes) {
      const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(keyframe->covariance);
      EXPECT_GT(eigen.eigenvalues()[0], 0.0);
    }
  }
  EXPECT_LT(six.keyframes[1]->covariance.trace(), two.keyframes[1]->covariance.trace());
}

TEST_F(WindowOptimizerTest, ImagesOverruleWhereKeyframesWereTrackedTo) {
  Window window = make_window(4, true);
  disturb(window, 1);
  for (const auto& keyframe : window.keyframes) keyframe->T_world_tracked = keyframe->T_world_camera;
  ASSERT_GT(largest_error(window), 0.003);
  optimizer_.optimize(window, camera_);
  EXPECT_LT(largest_error(window), 0.0015);
}

TEST_F(WindowOptimizerTest, WhereImagesSayNothingKeyframesStayWhereTheyWereTrackedTo) {
  Window window = make_window(2, true);
  for (const auto& keyframe : window.keyframes) {
    keyframe->points.clear();
    keyframe->anchors.clear();
    keyframe->T_world_tracked = SE3::exp(Vector6d::Constant(0.01)) * keyframe->T_world_camera;
  }
  std::vector<SE3> tracked;
  for (const auto& keyframe : window.keyframes) tracked.push_back(*keyframe->T_world_tracked);
  optimizer_.optimize(window, camera_);
  // The gauge holds the oldest keyframe with the same strength, so it ends halfway.
  const Vector6d newest = (window.keyframes[1]->T_world_camera * tracked[1].inverse()).log();
  EXPECT_LT(newest.norm(), 1e-4);
  const Vector6d oldest = (window.keyframes[0]->T_world_camera * tracked[0].inverse()).log();
  EXPECT_NEAR(oldest.norm(), 0.5 * Vector6d::Constant(0.01).norm(), 0.001);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT((window.keyframes[k]->T_world_tracked->inverse() * tracked[k]).log().norm(), 1e-9);
  }
}

TEST_F(WindowOptimizerTest, OneKeyframeWithoutAnchorStays) {
  Window window = make_window(1, false);
  const SE3 before = window.keyframes[0]->T_world_camera;
  EXPECT_EQ(optimizer_.optimize(window, camera_).iterations, 0);
  EXPECT_EQ(before.matrix(), window.keyframes[0]->T_world_camera.matrix());
  Window empty;
  EXPECT_EQ(optimizer_.optimize(empty, camera_).iterations, 0);
}

TEST_F(WindowOptimizerTest, FindsDisturbedDepthsAndPoses) {
  for (const DepthUse use : {DepthUse::free, DepthUse::prior, DepthUse::pose_aware_prior}) {
    Window window = make_window(5, true, use);
    disturb(window, 0);
    disturb_depths(window);
    WindowOptimizerOptions options;
    options.max_iterations = 15;
    WindowOptimizer(options).optimize(window, camera_);
    EXPECT_LT(largest_error(window), 0.002) << to_string(use);
    EXPECT_LT(depth_error(window), 0.004) << to_string(use);
  }
}

TEST_F(WindowOptimizerTest, APriorHoldsDepthsWhereTheyAreNotSeen) {
  // One keyframe: only the prior determines the depths of its points.
  Window window = make_window(1, true, DepthUse::prior);
  disturb_depths(window);
  optimizer_.optimize(window, camera_);
  for (const WindowPoint& point : window.keyframes[0]->points) EXPECT_NEAR(point.offset, 0.0, 1e-6);
}

TEST_F(WindowOptimizerTest, CeresFindsNoBetterOptimum) {
  for (const DepthUse use : {DepthUse::pose_aware, DepthUse::free, DepthUse::pose_aware_prior}) {
    Window ours = make_window(4, true, use, 60);
    Window theirs = make_window(4, true, use, 60);
    for (Window* window : {&ours, &theirs}) {
      disturb(*window, 0);
      if (use != DepthUse::pose_aware) disturb_depths(*window);
    }
    WindowOptimizerOptions options;
    options.max_iterations = 60;
    options.converged = 1e-10;
    const WindowSummary summary = WindowOptimizer(options).optimize(ours, camera_);
    const test::CeresOutcome ceres = test::optimize_with_ceres(theirs, camera_, options, 60);
    EXPECT_NEAR(summary.initial_cost, ceres.initial_cost, 1e-9 * ceres.initial_cost) << to_string(use);
    EXPECT_LT(summary.final_cost, 0.5 * summary.initial_cost);
    EXPECT_NEAR(summary.final_cost, ceres.final_cost, 1e-3 * ceres.final_cost) << to_string(use);
    EXPECT_LT(largest_difference(ours, theirs), 2e-5) << to_string(use);
  }
}

TEST_F(WindowOptimizerTest, MarginalizedKeyframesStillHoldTheOthers) {
  // Only the oldest keyframe is anchored: after it is marginalised, only its prior holds the others in the world. Depth
  // that moves with its keyframe determines the scale but not the position.
  std::map<bool, double> uncertainty;
  for (const bool kept : {true, false}) {
    Window window = make_window(4, true, DepthUse::prior);
    for (std::size_t k = 1; k < window.keyframes.size(); ++k) window.keyframes[k]->anchors.clear();
    optimizer_.optimize(window, camera_);
    MarginalizationOptions options;
    options.enabled = kept;
    marginalize_keyframe(window, 0, camera_, {}, options);
    ASSERT_EQ(window.keyframes.size(), 3U);
    EXPECT_EQ(window.prior.empty(), !kept);
    disturb(window, 0);
    WindowOptimizerOptions loose;
    loose.max_iterations = 20;
    loose.gauge_translation = 10.0;
    loose.gauge_rotation = 10.0;
    WindowOptimizer(loose).optimize(window, camera_);
    uncertainty[kept] = window.keyframes[1]->covariance.trace();
    if (!kept) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const SE3 error = test::room_path(6 * static_cast<int>(k + 1)).inverse() * window.keyframes[k]->T_world_camera;
      EXPECT_LT(error.translation().norm(), 0.003) << k;
    }
  }
  EXPECT_LT(uncertainty[true], 0.1 * uncertainty[false]);
}

TEST_F(WindowOptimizerTest, ThePriorOfMarginalizedKeyframesHasItsMinimumWhereTheyAgreed) {
  Window window = make_window(5, true);
  WindowOptimizerOptions options;
  options.max_iterations = 20;
  const WindowOptimizer optimizer(options);
  optimizer.optimize(window, camera_);
  marginalize_keyframe(window, 1, camera_, options, {});
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(window.prior.H);
  EXPECT_GT(eigen.eigenvalues()[0], -1e-6 * eigen.eigenvalues().tail<1>()[0]);
  std::vector<SE3> before;
  for (const auto& keyframe : window.keyframes) before.push_back(keyframe->T_world_camera);
  optimizer.optimize(window, camera_);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_LT((before[k].translation() - window.keyframes[k]->T_world_camera.translation()).norm(), 5e-4);
  }
}

TEST_F(WindowOptimizerTest, SameBitsWithAnyNumberOfThreads) {
  for (const DepthUse use : {DepthUse::pose_aware, DepthUse::free}) {
    std::vector<Eigen::Matrix4d> poses;
    const int before = threads();
    for (const int n : {1, 2, 5}) {
      set_threads(n);
      Window window = make_window(4, true, use);
      disturb(window, 0);
      optimizer_.optimize(window, camera_);
      marginalize_keyframe(window, 0, camera_, {}, {});
      optimizer_.optimize(window, camera_);
      poses.push_back(window.keyframes[2]->T_world_camera.matrix());
    }
    set_threads(before);
    EXPECT_EQ(poses[0], poses[1]);
    EXPECT_EQ(poses[0], poses[2]);
  }
}

}  // namespace
}  // namespace odosplat
