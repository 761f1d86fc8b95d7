// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/trajectories_figure.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "tests/viewer/figure_checks.hpp"
#include "tests/viewer/small_scene.hpp"

namespace odosplat {
namespace {

const Rgb estimate_color(230, 159, 0);
const Rgb lost_color(0, 90, 220);

TrajectoriesFigure four_circles(cv::Size size) {
  TrajectoriesFigure figure;
  figure.size = size;
  for (int k = 0; k < 4; ++k) {
    figure.panels.push_back({"sequence " + std::to_string(k) + ": ATE 2.1 mm", circle(90), circle(90)});
  }
  return figure;
}

TEST(TrajectoriesFigure, EveryPanelShowsItsPath) {
  const cv::Mat3b image = draw_trajectories(four_circles({800, 800}));
  for (const int x : {0, 400}) {
    for (const int y : {0, 370}) {
      const cv::Mat3b panel = image(cv::Rect(x, y, 400, 370));
      EXPECT_GT(count_near(panel, estimate_color, 0), 1000) << x << " " << y;
      EXPECT_EQ(count_near(panel, lost_color, 10), 0);
    }
  }
}

TEST(TrajectoriesFigure, TruthLiesOverTheEstimateWhereBothAgree) {
  TrajectoriesFigure figure = four_circles({800, 0});
  figure.panels.resize(1);
  const int together = count_near(draw_trajectories(figure), estimate_color, 0);
  figure.panels[0].truth.clear();
  EXPECT_LT(together, count_near(draw_trajectories(figure), estimate_color, 0));
  // Half a metre apart, both are completely visible.
  figure = four_circles({800, 0});
  figure.panels.resize(1);
  for (StampedPose& pose : figure.panels[0].estimate) {
    pose.T_world_camera =
        SE3(pose.T_world_camera.rotation(), pose.T_world_camera.translation() + Eigen::Vector3d(0.5, 0.0, 0.0));
  }
  EXPECT_GT(count_near(draw_trajectories(figure), estimate_color, 0), together);
}

TEST(TrajectoriesFigure, TheScaleBarIsTrue) {
  // A path of 4 m: 1 m is the round length of at most three tenths of the panel.
  TrajectoriesFigure figure;
  figure.size = {800, 600};
  figure.panels.resize(1);
  for (int k = 0; k <= 40; ++k) {
    figure.panels[0].estimate.push_back({k / 30.0, SE3(Eigen::Quaterniond::Identity(), {0.1 * k - 2.0, 0.0, 0.0}), ""});
  }
  figure.panels[0].up = {0.0, 0.0, 1.0};
  const cv::Mat3b image = draw_trajectories(figure);
  const cv::Mat3b panel = image(cv::Rect(0, 0, 800, 520));  // above the legend
  int low = panel.cols;
  int high = 0;
  int bar = 0;
  for (int y = 0; y < panel.rows; ++y) {
    int run = 0;
    for (int x = 0; x < panel.cols; ++x) {
      if (near_color(panel(y, x), estimate_color, 0)) {
        low = std::min(low, x);
        high = std::max(high, x);
      }
      run = panel(y, x) == Rgb(0, 0, 0) ? run + 1 : 0;
      bar = std::max(bar, run);
    }
  }
  EXPECT_NEAR(4.0 * bar / (high - low), 1.0, 0.06) << bar << " px of " << high - low;
}

TEST(TrajectoriesFigure, MarksWhatWasLost) {
  TrajectoriesFigure figure = four_circles({800, 800});
  auto& estimate = figure.panels[0].estimate;
  const int whole = count_near(draw_trajectories(figure)(cv::Rect(0, 0, 400, 370)), estimate_color, 0);
  estimate.erase(estimate.begin() + 30, estimate.begin() + 60);
  const cv::Mat3b panel = draw_trajectories(figure)(cv::Rect(0, 0, 400, 370));
  EXPECT_GT(count_near(panel, lost_color, 10), 50);
  EXPECT_LT(count_near(panel, estimate_color, 0), 0.8 * whole);
}

TEST(TrajectoriesFigure, NothingIsClippedAndTwiceTheSameBytes) {
  for (const cv::Size size : {cv::Size(400, 0), cv::Size(300, 700), cv::Size(1000, 300)}) {
    TrajectoriesFigure figure = four_circles(size);
    figure.panels[2].words = "a name that is longer than what fits over such a narrow panel: ATE 2.1 mm";
    const cv::Mat3b image = draw_trajectories(figure);
    EXPECT_EQ(image.cols, size.width);
    EXPECT_TRUE(margins_are_white(image, 1)) << size;
    EXPECT_TRUE(same_bytes(image, draw_trajectories(figure)));
  }
}

TEST(TrajectoriesFigure, EmptyAndTiny) {
  TrajectoriesFigure figure;
  figure.size = {200, 100};
  EXPECT_TRUE(ink_box(draw_trajectories(figure)).empty());
  figure.panels = {{"nothing", {}, {}}, {"one pose", circle(1), {}}, {"truth alone", {}, circle(20)}};
  EXPECT_FALSE(ink_box(draw_trajectories(figure)).empty());
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(64, 48), cv::Size(2000, 2000)}) {
    figure.size = size;
    EXPECT_EQ(draw_trajectories(figure).size(), size);
  }
  figure.size = {4, 4};
  EXPECT_THROW(draw_trajectories(figure), InputError);
}

}  // namespace
}  // namespace odosplat
