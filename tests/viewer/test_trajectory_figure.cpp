// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/trajectory_figure.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "tests/viewer/figure_checks.hpp"
#include "tests/viewer/small_scene.hpp"
#include "viewer/figures/decorations.hpp"

namespace odosplat {
namespace {

const Rgb lost_color(0, 90, 220);

Trajectory shifted(Trajectory trajectory, const Eigen::Vector3d& by) {
  for (auto& pose : trajectory) {
    pose.T_world_camera = SE3(pose.T_world_camera.rotation(), pose.T_world_camera.translation() + by);
  }
  return trajectory;
}

TrajectoryFigure circle_figure(cv::Size size) {
  TrajectoryFigure figure;
  figure.size = size;
  figure.map = grey_room();
  figure.truth = circle(90);
  figure.estimate = shifted(figure.truth, {0.0, 0.0, 0.01});
  figure.title = "ATE RMSE 10 mm";
  return figure;
}

TEST(PositionErrors, AreDistancesAtTheSameTime) {
  const Trajectory truth = circle(30);
  Trajectory estimate = shifted(truth, {0.0, 0.03, 0.04});
  for (const double e : position_errors(estimate, truth)) EXPECT_NEAR(e, 0.05, 1e-12);
  for (auto& pose : estimate) pose.time += 0.004;
  for (const double e : position_errors(estimate, truth)) EXPECT_NEAR(e, 0.05, 1e-12);
  for (auto& pose : estimate) pose.time += 100.0;
  for (const double e : position_errors(estimate, truth)) EXPECT_TRUE(std::isnan(e));
  EXPECT_TRUE(position_errors({}, truth).empty());
  EXPECT_TRUE(std::isnan(position_errors(estimate, {}).front()));
}

TEST(LostStretches, AreTheGapsOfTheEstimate) {
  const Trajectory truth = circle(100);
  EXPECT_TRUE(lost_stretches(truth, truth).empty());
  EXPECT_TRUE(lost_stretches({}, truth).empty());
  Trajectory gap = truth;
  gap.erase(gap.begin() + 40, gap.begin() + 50);
  const auto inside = lost_stretches(gap, truth);
  ASSERT_EQ(inside.size(), 1U);
  EXPECT_EQ(inside[0].size(), 12U);  // frames 39 to 50
  const auto straight = lost_stretches(gap, {});
  ASSERT_EQ(straight.size(), 1U);
  EXPECT_EQ(straight[0].size(), 2U);
  const Trajectory middle(truth.begin() + 20, truth.begin() + 70);
  EXPECT_EQ(lost_stretches(middle, truth).size(), 2U);
  // Times without images do not count as lost.
  EXPECT_TRUE(lost_stretches(middle, truth, TimeSpan{truth[20].time, truth[69].time}).empty());
  const auto end = lost_stretches(middle, truth, TimeSpan{truth[20].time, truth[89].time});
  ASSERT_EQ(end.size(), 1U);
  EXPECT_EQ(end[0].size(), 21U);  // frames 69 to 89
  EXPECT_EQ(lost_stretches(gap, truth, TimeSpan{truth[0].time, truth[99].time}).size(), 1U);
  Trajectory every_third;  // a slower camera is not lost
  for (std::size_t k = 0; k < truth.size(); k += 3) every_third.push_back(truth[k]);
  EXPECT_TRUE(lost_stretches(every_third, truth).empty());
}

TEST(TrajectoryFigure, ColorsFollowTheErrors) {
  TrajectoryFigure figure = circle_figure({800, 600});
  figure.map = {};
  figure.title.clear();
  figure.error_max = 0.1;
  const auto count_at = [&](double error) {
    figure.errors.assign(figure.estimate.size(), error);
    const cv::Mat3b image = draw_trajectory(figure);
    const double share = path_scale_start + (path_scale_end - path_scale_start) * std::min(error / 0.1, 1.0);
    // Only the panels, since the colour bar below them has all colours.
    return count_near(image(cv::Rect(0, 0, 800, 400)), scale_color(ColorScale::error, share), 2);
  };
  const int low = count_at(0.0);
  EXPECT_GT(low, 500);
  EXPECT_NEAR(count_at(0.05), low, 0.1 * low);
  EXPECT_NEAR(count_at(0.3), low, 0.1 * low);
}

TEST(TrajectoryFigure, MarksLostStretches) {
  TrajectoryFigure figure = circle_figure({800, 600});
  EXPECT_EQ(count_near(draw_trajectory(figure), lost_color, 10), 0);
  figure.estimate.erase(figure.estimate.begin() + 30, figure.estimate.begin() + 60);
  EXPECT_GT(count_near(draw_trajectory(figure)(cv::Rect(0, 0, 800, 400)), lost_color, 10), 200);
  figure.estimate.resize(30);
  EXPECT_GT(count_near(draw_trajectory(figure)(cv::Rect(0, 0, 800, 400)), lost_color, 10), 200);
  figure.span = TimeSpan{figure.estimate.front().time, figure.estimate.back().time};
  EXPECT_EQ(count_near(draw_trajectory(figure), lost_color, 10), 0);
}

TEST(TrajectoryFigure, TheScaleBarIsTrue) {
  // A path of 4 m seen from above, and the scale bar of that panel: its length must match its label of 1 m, the largest
  // of the 1-2-5 series that takes at most three tenths of the panel.
  TrajectoryFigure figure;
  figure.size = {800, 600};
  for (int k = 0; k <= 40; ++k) {
    figure.estimate.push_back({k / 30.0, SE3(Eigen::Quaterniond::Identity(), {0.1 * k - 2.0, 0.0, 0.0}), ""});
  }
  figure.up = {0.0, 0.0, 1.0};
  const cv::Mat3b image = draw_trajectory(figure);
  const cv::Mat3b panel = image(cv::Rect(0, 0, 400, 535));
  int low = panel.cols;
  int high = 0;
  int bar = 0;
  for (int y = 0; y < panel.rows; ++y) {
    int run = 0;
    for (int x = 0; x < panel.cols; ++x) {
      if (near_color(panel(y, x), {0, 114, 178}, 10)) {
        low = std::min(low, x);
        high = std::max(high, x);
      }
      run = panel(y, x) == Rgb(0, 0, 0) ? run + 1 : 0;
      bar = std::max(bar, run);
    }
  }
  const double pixels_per_metre = (high - low) / 4.0;
  const double metres = bar / pixels_per_metre;
  EXPECT_NEAR(metres, 1.0, 0.06) << bar << " px of " << pixels_per_metre;
}

TEST(TrajectoryFigure, NothingIsClipped) {
  for (const cv::Size size : {cv::Size(400, 300), cv::Size(300, 600), cv::Size(1000, 300)}) {
    TrajectoryFigure figure = circle_figure(size);
    figure.title = "a long title with figures: ATE RMSE 10.0 mm, median 10.0 mm, max 10.0 mm, 90 of 90 frames posed";
    figure.estimate.erase(figure.estimate.begin() + 30, figure.estimate.begin() + 60);
    const cv::Mat3b image = draw_trajectory(figure);
    EXPECT_EQ(image.size(), size);
    EXPECT_TRUE(margins_are_white(image, 2)) << size;
  }
}

TEST(TrajectoryFigure, AnySizeTwiceTheSameBytes) {
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(64, 48), cv::Size(480, 360)}) {
    const TrajectoryFigure figure = circle_figure(size);
    const cv::Mat3b image = draw_trajectory(figure);
    EXPECT_EQ(image.size(), size);
    EXPECT_TRUE(same_bytes(image, draw_trajectory(figure))) << size;
  }
  EXPECT_EQ(draw_trajectory(circle_figure({3000, 2000})).size(), cv::Size(3000, 2000));
}

TEST(TrajectoryFigure, EmptyAndTinyPathsGiveAFigure) {
  TrajectoryFigure figure;
  figure.size = {320, 240};
  EXPECT_EQ(draw_trajectory(figure).size(), cv::Size(320, 240));
  figure.truth = circle(50);
  EXPECT_EQ(draw_trajectory(figure).size(), cv::Size(320, 240));
  figure.estimate = circle(1);
  EXPECT_EQ(draw_trajectory(figure).size(), cv::Size(320, 240));
  figure.truth.clear();
  EXPECT_EQ(draw_trajectory(figure).size(), cv::Size(320, 240));
  figure.map = grey_room();
  figure.estimate.clear();
  EXPECT_EQ(draw_trajectory(figure).size(), cv::Size(320, 240));
}

TEST(TrajectoryFigure, RefusesErrorsOfAnotherLength) {
  TrajectoryFigure figure = circle_figure({320, 240});
  figure.errors = {0.1};
  EXPECT_THROW(draw_trajectory(figure), InputError);
}

}  // namespace
}  // namespace odosplat
