// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/map_figure.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "odosplat/core/error.hpp"
#include "tests/viewer/figure_checks.hpp"
#include "tests/viewer/small_scene.hpp"

namespace odosplat {
namespace {

const Rgb path_color(213, 94, 0);

MapFigure room_figure(cv::Size size) {
  MapFigure figure;
  figure.size = size;
  figure.map = grey_room();
  figure.cameras = circle(30);
  return figure;
}

TEST(MapFigure, ARedPointIsWhereItIsSaidToBe) {
  MapFigure figure = room_figure({480, 360});
  figure.title = "a room";
  figure.cameras = circle(3);
  figure.frusta = 0;
  const Eigen::Vector3d p_world(-1.2, 1.2, 1.0);  // over the floor, away from the path
  figure.map.cloud.points.push_back(p_world.cast<float>());
  figure.map.cloud.normals.emplace_back(0.0F, -1.0F, 0.0F);
  figure.map.cloud.colors.emplace_back(1.0F, 0.0F, 0.0F);
  figure.map.radii.push_back(0.06F);
  const cv::Mat3b image = draw_map(figure);
  const auto expected = locate_in_map_figure(figure, p_world);
  ASSERT_TRUE(expected);
  ASSERT_GT(count_near(image, {255, 0, 0}, 20), 10);
  const cv::Point2d center = center_of(image, {255, 0, 0}, 20);
  EXPECT_NEAR(center.x, expected->x(), 1.0);
  EXPECT_NEAR(center.y, expected->y(), 1.0);
}

TEST(MapFigure, OpensTheRoomLikeADollsHouse) {
  // The ceiling and the near walls would hide the floor: the floor is painted green and its pixels are counted.
  MapFigure figure = room_figure({480, 360});
  for (std::size_t i = 0; i < figure.map.cloud.points.size(); ++i) {
    if (figure.map.cloud.points[i].y() > 1.2F) figure.map.cloud.colors[i] = {0.0F, 0.7F, 0.0F};
  }
  const int open = count_near(draw_map(figure), {0, 179, 0}, 4);
  EXPECT_GT(open, 480 * 360 / 8);
  figure.map.cloud.normals.clear();  // estimated from the points, except near edges
  const int estimated = count_near(draw_map(figure), {0, 179, 0}, 4);
  EXPECT_GT(estimated, open * 8 / 10);
  figure.cameras.clear();  // without cameras the normals have no side and there is no cut: the floor is hidden
  figure.up = {0.0, -1.0, 0.0};
  EXPECT_LT(count_near(draw_map(figure), {0, 179, 0}, 4), open / 4);
}

TEST(MapFigure, CutHeightTakesOffWhatIsHigher) {
  MapFigure figure = room_figure({320, 240});
  figure.cut_height = -1.0;  // 0.25 m over the floor, which is at y = 1.25
  const MapScenery scenery = prepare_map(figure.map, figure.cameras, figure.up, figure.cut_height);
  const FigureView view = view_from_corner(scenery.axes, scenery.extent, {320, 240}, 0.02, 0.4, 0.8);
  const FigureLayer layer = map_layer(scenery, view, 0.0);
  ASSERT_FALSE(layer.mesh.empty());
  for (const auto& vertex : layer.mesh.vertices()) EXPECT_GT(vertex.y() + layer.mesh.origin().y(), 0.9);
}

TEST(MapFigure, ShowsTheFrustaAskedFor) {
  MapFigure figure = room_figure({480, 360});
  figure.frusta = 0;
  const int path_only = count_near(draw_map(figure), path_color, 30);
  figure.frusta = 10;
  const int with_frusta = count_near(draw_map(figure), path_color, 30);
  EXPECT_GT(path_only, 50);
  EXPECT_GT(with_frusta, path_only + 200);
  figure.frusta = -1;
  EXPECT_THROW(draw_map(figure), InputError);
}

TEST(MapFigure, AnySizeTwiceTheSameBytes) {
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(64, 48), cv::Size(400, 300), cv::Size(300, 500)}) {
    const MapFigure figure = room_figure(size);
    const cv::Mat3b image = draw_map(figure);
    EXPECT_EQ(image.size(), size);
    EXPECT_FALSE(ink_box(image).empty());
    EXPECT_TRUE(same_bytes(image, draw_map(figure))) << size;
  }
  EXPECT_EQ(draw_map(room_figure({3000, 2000})).size(), cv::Size(3000, 2000));
  EXPECT_EQ(draw_map(room_figure({200, 0})).size(), cv::Size(200, 150));
}

TEST(MapFigure, EmptyMapAndPathGiveAFigure) {
  MapFigure figure;
  figure.size = {200, 150};
  EXPECT_EQ(draw_map(figure).size(), cv::Size(200, 150));
  figure.cameras = circle(1);
  EXPECT_GT(count_near(draw_map(figure), path_color, 40), 10);
  figure.cameras = circle(20);
  EXPECT_GT(count_near(draw_map(figure), path_color, 40), 40);
  figure.cameras.clear();
  figure.map.cloud.points = {{1.0F, 2.0F, 3.0F}};
  EXPECT_FALSE(ink_box(draw_map(figure)).empty());
}

TEST(MapFigure, BrokenPointsAreLeftOutAndUnevenArraysRefused) {
  MapFigure figure = room_figure({200, 150});
  const cv::Mat3b sound = draw_map(figure);
  figure.map.cloud.points.emplace_back(std::numeric_limits<float>::quiet_NaN(), 0.0F, 0.0F);
  EXPECT_THROW(draw_map(figure), InputError);  // colours, normals and radii have one entry less
  figure.map.cloud.normals.emplace_back(0.0F, -1.0F, 0.0F);
  figure.map.cloud.colors.emplace_back(1.0F, 0.0F, 0.0F);
  figure.map.radii.push_back(0.06F);
  EXPECT_TRUE(same_bytes(sound, draw_map(figure)));
}

TEST(MapFigure, ALongTitleStaysOnThePage) {
  MapFigure figure;
  figure.size = {400, 300};
  figure.title = "a title that is much longer than any page of this size could ever hold in one line of text";
  const cv::Mat3b image = draw_map(figure);
  EXPECT_FALSE(ink_box(image).empty());
  EXPECT_TRUE(margins_are_white(image, 3));
}

TEST(MapFigure, FarFromTheOriginLooksTheSame) {
  MapFigure figure = room_figure({320, 240});
  const cv::Mat3b here = draw_map(figure);
  const Eigen::Vector3d shift(4096.0, -1024.0, 2048.0);  // floats represent the room's points there to 0.5 mm
  for (auto& p : figure.map.cloud.points) p += shift.cast<float>();
  for (auto& pose : figure.cameras) {
    pose.T_world_camera = SE3(pose.T_world_camera.rotation(), pose.T_world_camera.translation() + shift);
  }
  const cv::Mat3b there = draw_map(figure);
  int different = 0;
  for (int y = 0; y < here.rows; ++y) {
    for (int x = 0; x < here.cols; ++x) different += near_color(here(y, x), there(y, x), 60) ? 0 : 1;
  }
  EXPECT_LT(different, here.rows * here.cols / 50);
}

}  // namespace
}  // namespace odosplat
