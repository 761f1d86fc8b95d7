// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figures/association_figure.hpp"

#include <gtest/gtest.h>

#include "odosplat/core/error.hpp"
#include "tests/viewer/figure_checks.hpp"
#include "viewer/color_map.hpp"
#include "viewer/figures/fly_frame.hpp"

namespace odosplat {
namespace {

const Camera camera{80, 60, 70.0, 70.0, 39.5, 29.5};

/// A wall of points at `depth` [m] in front of a camera at the origin.
void add_wall(PointCloud& cloud, float depth) {
  for (int y = 2; y < 60; y += 4) {
    for (int x = 2; x < 80; x += 4) cloud.points.push_back((depth * camera.ray(x, y)).cast<float>());
  }
}

/// Interpolated depth 2 m with a hole, rendered depth 3 m, points at 3 m.
AssociationFigure wall_figure(cv::Size size) {
  AssociationFigure figure;
  figure.size = size;
  figure.camera = camera;
  figure.interpolated = DepthImage(60, 80, 2.0F);
  figure.interpolated(cv::Rect(30, 20, 20, 20)).setTo(0.0F);
  figure.rendered = DepthImage(60, 80, 3.0F);
  figure.image = ColorImage(60, 80, cv::Vec3f(0.2F, 0.4F, 0.6F));
  figure.depth_min = 1.0;
  figure.depth_max = 4.0;
  add_wall(figure.cloud, 3.0F);
  return figure;
}

Rgb color_at(double depth) { return scale_color(ColorScale::depth, 0.85 * (depth - 1.0) / 3.0); }

TEST(AssociationFigure, OneScaleForPointsAndImages) {
  const cv::Mat3b image = draw_association(wall_figure({800, 0}));
  const cv::Rect top_left(0, 0, 400, image.rows / 2);
  const cv::Rect top_right(400, 0, 400, image.rows / 2);
  EXPECT_GT(count_near(image(top_left), color_at(2.0), 2), 30000);
  EXPECT_GT(count_near(image(top_left), hatch_light, 0), 3000);
  EXPECT_GT(count_near(image(top_right), color_at(3.0), 2), 30000);
  const cv::Rect bottom_left(0, 345, 400, 290);  // the panel of the points, without the colour bar
  EXPECT_GT(count_near(image(bottom_left), color_at(3.0), 2), 1000);
  EXPECT_GT(count_near(image(bottom_left), {255, 255, 255}, 0), 30000);
  EXPECT_GT(count_near(image, {51, 102, 153}, 1), 30000);
}

TEST(AssociationFigure, PointsLieWhereTheyProject) {
  AssociationFigure figure = wall_figure({800, 0});
  figure.cloud.points = {(3.0 * camera.ray(39.5, 29.5)).cast<float>()};
  const cv::Mat3b image = draw_association(figure);
  const cv::Rect bottom_left(0, 345, 400, 290);
  const cv::Point2d at = center_of(image(bottom_left), color_at(3.0), 2);
  // The point must be in the middle of the panel, whose frame is the bounding box of this part except for the gaps.
  const cv::Rect frame = ink_box(image(bottom_left));
  EXPECT_NEAR(at.x, 0.5 * (frame.x + frame.br().x), 12.0);
  figure.T_world_camera = SE3(Eigen::Quaterniond::Identity(), {0.6, 0.0, 0.0});  // 14 px of 80 to the left
  const cv::Point2d moved = center_of(draw_association(figure)(bottom_left), color_at(3.0), 2);
  EXPECT_NEAR((at.x - moved.x) * 80.0 / 380.0, 14.0, 1.0);
  EXPECT_NEAR(at.y, moved.y, 0.5);
}

TEST(AssociationFigure, HidesPointsBehindTheRenderedSurface) {
  AssociationFigure figure = wall_figure({800, 0});
  figure.cloud.points.clear();
  add_wall(figure.cloud, 3.8F);
  const cv::Rect bottom_left(0, 345, 400, 290);
  EXPECT_EQ(count_near(draw_association(figure)(bottom_left), color_at(3.8), 2), 0);
  figure.rendered.setTo(0.0F);  // without rendered depth no point is hidden
  EXPECT_GT(count_near(draw_association(figure)(bottom_left), color_at(3.8), 2), 1000);
  figure.cloud.points = {{0.0F, 0.0F, -2.0F}, {0.0F, 0.0F, 0.0F}};  // behind the camera, and at its centre
  EXPECT_NO_THROW(draw_association(figure));
}

TEST(AssociationFigure, NothingIsClipped) {
  for (const bool with_image : {true, false}) {
    for (const cv::Size size : {cv::Size(400, 0), cv::Size(400, 300), cv::Size(300, 900)}) {
      AssociationFigure figure = wall_figure(size);
      if (!with_image) figure.image = ColorImage();
      figure.title = "a title that is longer than what fits into the width of such a narrow page";
      const cv::Mat3b image = draw_association(figure);
      EXPECT_EQ(image.cols, size.width);
      EXPECT_TRUE(margins_are_white(image, 1)) << size;
      EXPECT_TRUE(same_bytes(image, draw_association(figure)));
    }
  }
}

TEST(AssociationFigure, EmptyTinyAndUneven) {
  AssociationFigure figure = wall_figure({16, 16});
  EXPECT_EQ(draw_association(figure).size(), cv::Size(16, 16));
  figure.size = {200, 0};
  figure.cloud = {};
  figure.depth_min = figure.depth_max = 0.0;
  EXPECT_EQ(draw_association(figure).cols, 200);
  figure.rendered = DepthImage(3, 3, 1.0F);
  EXPECT_THROW(draw_association(figure), InputError);
}

TEST(FlyFrame, HoldsColourAndDepthSideBySide) {
  FlyFrame frame;
  frame.color = ColorImage(60, 81, cv::Vec3f(0.2F, 0.4F, 0.6F));
  frame.depth = DepthImage(60, 81, 2.0F);
  frame.range = {1.0, 3.0};
  frame.words = "1.25 s";
  const cv::Mat3b image = draw_fly_frame(frame);
  EXPECT_EQ(image.cols, 162);
  EXPECT_EQ(image.rows % 2, 0);
  EXPECT_EQ(count_near(image(cv::Rect(0, 0, 81, 60)), {51, 102, 153}, 1), 81 * 60);
  EXPECT_EQ(count_near(image(cv::Rect(81, 0, 81, 60)), scale_color(ColorScale::depth, 0.5), 0), 81 * 60);
  frame.words = "10.25 s and a word that does not fit";
  EXPECT_EQ(draw_fly_frame(frame).size(), image.size());
  frame.color = ColorImage();
  EXPECT_EQ(draw_fly_frame(frame).cols, 82);
  frame.color = ColorImage(3, 3);
  EXPECT_THROW(draw_fly_frame(frame), InputError);
  EXPECT_THROW(draw_fly_frame({}), InputError);
}

}  // namespace
}  // namespace odosplat
