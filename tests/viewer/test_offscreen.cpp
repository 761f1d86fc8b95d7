// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/offscreen.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <thread>
#include <vector>

#include "tests/viewer/figure_checks.hpp"

namespace odosplat {
namespace {

const Rgb white(255, 255, 255);
const Rgb red(255, 0, 0);
const Rgb green(0, 160, 0);

/// Every test of this program runs without an X server.
class NoDisplay : public testing::Environment {
 public:
  void SetUp() override {
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
  }
};
const testing::Environment* const no_display = testing::AddGlobalTestEnvironment(new NoDisplay);

FigureView perspective_view(int width, int height) {
  FigureView view;
  view.size = {width, height};
  view.focal = 300.0;
  view.cx = 0.5 * (width - 1) + 20.0;  // off centre, to detect a wrong sign
  view.cy = 0.5 * (height - 1) - 10.0;
  view.T_world_view = SE3(so3_exp({0.2, -0.4, 0.3}), {1.0, -2.0, 0.5});
  return view;
}

FigureLayer ball_layer(const Eigen::Vector3d& p_world, double radius, const Rgb& color) {
  FigureLayer layer{FigureMesh(p_world + Eigen::Vector3d(3.0, 0.0, 1.0))};
  layer.mesh.add_ball(p_world, radius, color);
  return layer;
}

TEST(OffscreenWindow, PutsPointsWhereTheViewSays) {
  OffscreenWindow window;
  for (const bool perspective : {true, false}) {
    FigureView view = perspective_view(320, 240);
    view.perspective = perspective;
    if (!perspective) view.focal = 60.0;
    for (const Eigen::Vector3d& p_view :
         {Eigen::Vector3d(0.0, 0.0, 4.0), Eigen::Vector3d(1.2, 0.8, 5.0), Eigen::Vector3d(-1.4, -0.7, 3.5)}) {
      const Eigen::Vector3d p_world = view.T_world_view * p_view;
      const cv::Mat3b picture = window.render({ball_layer(p_world, 0.05, red)}, view, white);
      const auto expected = view.project(p_world);
      ASSERT_TRUE(expected);
      ASSERT_GT(count_near(picture, red, 40), 8);
      const cv::Point2d center = center_of(picture, red, 40);
      EXPECT_NEAR(center.x, expected->x(), 0.4) << perspective;
      EXPECT_NEAR(center.y, expected->y(), 0.4) << perspective;
    }
  }
}

TEST(OffscreenWindow, NearHidesFarWithinALayerAndLaterLayersHideEarlier) {
  OffscreenWindow window;
  const FigureView view = perspective_view(160, 120);
  const auto at = [&](double z) { return view.T_world_view * Eigen::Vector3d(0.0, 0.0, z); };
  FigureLayer both{FigureMesh(at(2.0))};
  both.mesh.add_ball(at(3.0), 0.1, red);
  both.mesh.add_ball(at(6.0), 0.1, green);
  EXPECT_EQ(count_near(window.render({both}, view, white), green, 30), 0);
  const cv::Mat3b layered =
      window.render({ball_layer(at(3.0), 0.1, red), ball_layer(at(6.0), 0.1, green)}, view, white);
  EXPECT_GT(count_near(layered, green, 30), 20);
  EXPECT_GT(count_near(layered, red, 30), 20);
}

TEST(OffscreenWindow, LeavesOutBacksWhenTold) {
  OffscreenWindow window;
  const FigureView view = perspective_view(160, 120);
  const Eigen::Vector3d p = view.T_world_view * Eigen::Vector3d(0.0, 0.0, 3.0);
  const Eigen::Vector3d toward_viewer = -view.T_world_view.rotation_matrix().col(2);
  for (const double side : {1.0, -1.0}) {
    for (const bool cull : {true, false}) {
      FigureLayer layer{FigureMesh(p), cull};
      layer.mesh.add_disc(p, side * toward_viewer, 0.2, 12, red);
      const int seen = count_near(window.render({layer}, view, white), red, 10);
      if (cull && side < 0.0) {
        EXPECT_EQ(seen, 0);
      } else {
        EXPECT_NEAR(seen, 3.14 * 20.0 * 20.0, 120.0);
      }
    }
  }
}

TEST(OffscreenWindow, ColorsArriveUnchanged) {
  OffscreenWindow window;
  FigureView view = perspective_view(100, 80);
  const Rgb color(12, 200, 77);
  const Eigen::Vector3d p = view.T_world_view * Eigen::Vector3d(0.0, 0.0, 3.0);
  const cv::Mat3b picture = window.render({ball_layer(p, 0.1, color)}, view, {250, 240, 230});
  const auto pixel = view.project(p);
  EXPECT_EQ(picture(cv::Point(static_cast<int>(pixel->x()), static_cast<int>(pixel->y()))), color);
  EXPECT_EQ(picture(0, 0), Rgb(250, 240, 230));
}

TEST(OffscreenWindow, TilesJoinWithoutASeam) {
  // Wider than a tile: a horizontal band must continue without a gap.
  OffscreenWindow window;
  FigureView view;
  view.size = {5000, 40};
  view.perspective = false;
  view.focal = 1000.0;
  view.cx = 2499.5;
  view.cy = 19.5;
  FigureLayer layer{FigureMesh(Eigen::Vector3d::Zero())};
  layer.mesh.add_tube({-2.4, 0.0, 1.0}, {2.4, 0.0, 1.0}, 0.01, red, red);
  const cv::Mat3b picture = window.render({layer}, view, white);
  ASSERT_EQ(picture.size(), view.size);
  for (int x = 105; x < 4895; ++x) ASSERT_EQ(picture(20, x), red) << x;
  EXPECT_EQ(picture(20, 90), white);
  EXPECT_EQ(picture(20, 4910), white);
}

TEST(OffscreenWindow, SameCallSameBytes) {
  const FigureView view = perspective_view(160, 120);
  const FigureLayer layer = ball_layer(view.T_world_view * Eigen::Vector3d(0.1, 0.2, 3.0), 0.4, red);
  OffscreenWindow first;
  const cv::Mat3b picture = first.render({layer}, view, white);
  EXPECT_TRUE(same_bytes(picture, first.render({layer}, view, white)));
  OffscreenWindow second;
  EXPECT_TRUE(same_bytes(picture, second.render({layer}, view, white)));
}

TEST(OffscreenWindow, NoLayersAndEmptyMeshesGiveTheBackground) {
  OffscreenWindow window;
  const FigureView view = perspective_view(17, 9);
  EXPECT_EQ(count_near(window.render({}, view, green), green, 0), 17 * 9);
  EXPECT_EQ(count_near(window.render({FigureLayer{}, FigureLayer{}}, view, green), green, 0), 17 * 9);
}

TEST(OffscreenWindow, IsSilentAndLeavesNothingOpen) {
  const auto open_files = [] {
    const std::filesystem::directory_iterator files("/proc/self/fd");
    return std::distance(begin(files), end(files));
  };
  const FigureView view = perspective_view(64, 48);
  const FigureLayer layer = ball_layer(view.T_world_view * Eigen::Vector3d(0.0, 0.0, 3.0), 0.4, red);
  { OffscreenWindow().render({layer}, view, white); }
  const auto before = open_files();
  testing::internal::CaptureStderr();
  for (int i = 0; i < 4; ++i) OffscreenWindow().render({layer}, view, white);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(open_files(), before);
}

TEST(OffscreenWindow, OneAThread) {
  const FigureView view = perspective_view(64, 48);
  const FigureLayer layer = ball_layer(view.T_world_view * Eigen::Vector3d(0.0, 0.0, 3.0), 0.4, red);
  const cv::Mat3b expected = OffscreenWindow().render({layer}, view, white);
  std::vector<cv::Mat3b> pictures(3);
  for (auto& picture : pictures) {  // one after another, as VTK does not support several at once
    std::thread([&] { picture = OffscreenWindow().render({layer}, view, white); }).join();
  }
  for (const auto& picture : pictures) EXPECT_TRUE(same_bytes(picture, expected));
}

TEST(OffscreenWindow, NamesItsRenderer) {
  OffscreenWindow window;
  EXPECT_NE(window.renderer().find(", "), std::string::npos);
  EXPECT_EQ(window.renderer().find("unknown"), std::string::npos) << window.renderer();
}

}  // namespace
}  // namespace odosplat
