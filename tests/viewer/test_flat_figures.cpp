// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "tests/viewer/figure_checks.hpp"
#include "viewer/color_map.hpp"
#include "viewer/figures/compare_figure.hpp"
#include "viewer/figures/depth_figure.hpp"
#include "viewer/figures/error_plot.hpp"

namespace odosplat {
namespace {

/// Depth from 1 m at the left to 4 m at the right, with a hole; plus `more` [m], all times `factor`.
DepthImage ramp(float more = 0.0F, float factor = 1.0F) {
  DepthImage depth(60, 80);
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      depth(y, x) = factor * (1.0F + more + 3.0F * static_cast<float>(x) / 79.0F);
    }
  }
  depth(cv::Rect(30, 20, 10, 10)).setTo(0.0F);
  return depth;
}

CompareFigure two_methods(cv::Size size, int examples) {
  CompareFigure figure;
  figure.size = size;
  for (int e = 0; e < examples; ++e) {
    CompareExample example;
    example.name = "frame " + std::to_string(e);
    example.image = ColorImage(60, 80, cv::Vec3f(0.5F, 0.4F, 0.3F));
    example.truth = ramp();
    example.methods = {{"interpolated", ramp(0.05F)}, {"rendered", ramp(0.01F)}};
    figure.examples.push_back(example);
  }
  return figure;
}

ErrorPlot two_curves(cv::Size size) {
  ErrorPlot plot;
  plot.size = size;
  for (int s = 0; s < 2; ++s) {
    ErrorSeries series{s == 0 ? "gaussian" : "interpolation", {}, {}};
    for (int k = 0; k < 100; ++k) {
      series.times.push_back(10.0 + k / 30.0);
      series.errors.push_back((s + 1) * 0.005);
    }
    plot.series.push_back(series);
  }
  return plot;
}

TEST(DepthRange, LeavesOutHolesAndStrayValues) {
  cv::Mat1f image(10, 100, 2.0F);
  image(0, 0) = 0.0F;
  image(0, 1) = std::numeric_limits<float>::infinity();
  image(0, 2) = 900.0F;
  const ValueRange range = depth_range_of({&image});
  EXPECT_NEAR(range.low, 2.0, 0.01);
  EXPECT_NEAR(range.high, 2.0, 0.01);
  EXPECT_LT(range.low, range.high);
  const cv::Mat1f nothing(4, 4, 0.0F);
  EXPECT_EQ(depth_range_of({&nothing}).high, 1.0);
}

TEST(DepthFigure, GetsLighterWithDepthAndHatchesHoles) {
  DepthFigure figure;
  figure.size = {400, 0};
  figure.depth = ramp();
  const cv::Mat3b image = draw_depth(figure);
  ASSERT_EQ(image.cols, 400);
  const int row = image.rows / 4;
  double last = -1.0;
  for (int x = 20; x < 380; x += 12) {
    const double l = lightness(image(row, x));
    EXPECT_GT(l, last) << x;
    last = l;
  }
  EXPECT_GT(count_near(image, hatch_dark, 0), 100);
  EXPECT_GT(count_near(image, hatch_light, 0), 200);
  figure.depth = DepthImage(60, 80, 2.0F);
  // Without holes only the sample that explains the hatching remains.
  EXPECT_LT(count_near(draw_depth(figure), hatch_light, 0), 200);
}

TEST(DepthFigure, GivenRangeIsUsed) {
  DepthFigure figure;
  figure.size = {400, 0};
  figure.depth = DepthImage(60, 80, 2.0F);
  figure.depth_min = 1.0;
  figure.depth_max = 3.0;
  EXPECT_GT(count_near(draw_depth(figure), scale_color(ColorScale::depth, 0.5), 0), 50000);
  figure.depth_max = 0.5;
  EXPECT_THROW(draw_depth(figure), InputError);
}

TEST(DepthFigure, FourPanelsNothingClipped) {
  for (const cv::Size size : {cv::Size(400, 0), cv::Size(400, 300), cv::Size(300, 900)}) {
    DepthFigure figure;
    figure.size = size;
    figure.depth = ramp();
    figure.color = ColorImage(60, 80, cv::Vec3f(0.2F, 0.4F, 0.6F));
    figure.sigma = ramp(0.0F, 0.01F);
    figure.alpha = cv::Mat1f(60, 80, 0.9F);
    figure.title = "a title that is longer than what fits into the width of such a narrow page";
    const cv::Mat3b image = draw_depth(figure);
    EXPECT_TRUE(margins_are_white(image, 2)) << size;
    EXPECT_GT(count_near(image, {51, 102, 153}, 1), image.rows * image.cols / 40);
    EXPECT_TRUE(same_bytes(image, draw_depth(figure)));
  }
}

TEST(DepthFigure, EmptyTinyAndUneven) {
  DepthFigure figure;
  figure.size = {100, 80};
  EXPECT_EQ(draw_depth(figure).size(), cv::Size(100, 80));
  figure.depth = DepthImage(3, 1, 1.0F);
  EXPECT_EQ(draw_depth(figure).size(), cv::Size(100, 80));
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(32, 24), cv::Size(3000, 2000)}) {
    figure.size = size;
    EXPECT_EQ(draw_depth(figure).size(), size);
  }
  figure.sigma = cv::Mat1f(2, 2, 1.0F);
  EXPECT_THROW(draw_depth(figure), InputError);
}

TEST(CompareFigure, HoldsItsPanelsUnclipped) {
  for (const int examples : {1, 3}) {
    for (const cv::Size size : {cv::Size(800, 0), cv::Size(800, 300), cv::Size(400, 900)}) {
      const CompareFigure figure = two_methods(size, examples);
      const cv::Mat3b image = draw_compare(figure);
      EXPECT_EQ(image.cols, size.width);
      EXPECT_TRUE(margins_are_white(image, 1)) << size;
      EXPECT_GT(count_near(image, {128, 102, 77}, 1), examples * 1000 * size.width / 800 / 2);
      EXPECT_TRUE(same_bytes(image, draw_compare(figure)));
    }
  }
}

TEST(CompareFigure, OneErrorScaleForAll) {
  CompareFigure figure = two_methods({800, 0}, 1);
  figure.error_max = 0.1;
  const cv::Mat3b image = draw_compare(figure);
  const int panel = 80 * 60 * 4;  // a panel of this page is more than twice the images' size
  EXPECT_GT(count_near(image, scale_color(ColorScale::error, 0.5), 2), panel / 2);  // 5 cm
  EXPECT_GT(count_near(image, scale_color(ColorScale::error, 0.1), 2), panel / 2);  // 1 cm
}

TEST(CompareFigure, WithoutTruthThereAreNoErrors) {
  CompareFigure figure = two_methods({800, 0}, 1);
  const int with_truth = draw_compare(figure).rows;
  figure.examples[0].truth = DepthImage();
  const cv::Mat3b without = draw_compare(figure);
  EXPECT_LT(without.rows, with_truth);
  EXPECT_EQ(count_near(without, scale_color(ColorScale::error, 0.5), 2), 0);
  EXPECT_TRUE(margins_are_white(without, 1));
}

TEST(CompareFigure, RefusesWhatDoesNotFit) {
  CompareFigure figure = two_methods({800, 0}, 2);
  figure.examples[1].methods[0].name = "other";
  EXPECT_THROW(draw_compare(figure), InputError);
  figure = two_methods({800, 0}, 1);
  figure.examples[0].truth = DepthImage(2, 2, 1.0F);
  EXPECT_THROW(draw_compare(figure), InputError);
  figure.examples.clear();
  EXPECT_THROW(draw_compare(figure), InputError);
  EXPECT_EQ(draw_compare(two_methods({16, 16}, 2)).size(), cv::Size(16, 16));
}

TEST(ErrorPlot, CurvesLieWhereTheirValuesAre) {
  // 5 mm and 10 mm on an axis from 0 to 15 mm: two levels, in the right order and a third of the axis apart.
  const cv::Mat3b image = draw_error_plot(two_curves({800, 0}));
  const cv::Rect body(200, 90, 550, 240);  // without the legend
  const double low = center_of(image(body), series_color(0), 3).y;
  const double high = center_of(image(body), series_color(1), 3).y;
  EXPECT_GT(low, high);
  int top = -1;
  int bottom = -1;
  const Rgb black(0, 0, 0);
  for (int y = 0; y < image.rows; ++y) {  // only the two rows of the frame are black over the whole width
    if (image(y, 300) != black || image(y, 500) != black || image(y, 700) != black) continue;
    if (top < 0) top = y;
    bottom = y;
  }
  ASSERT_GE(top, 0);
  EXPECT_NEAR(low - high, (bottom - top) / 3.0, 3.0);
}

TEST(ErrorPlot, BreaksWhereFramesWereLost) {
  ErrorPlot plot = two_curves({800, 0});
  plot.series.resize(1);
  const int whole = count_near(draw_error_plot(plot), series_color(0), 3);
  ErrorPlot broken = plot;
  for (int k = 30; k < 70; ++k) broken.series[0].errors[static_cast<std::size_t>(k)] = std::nan("");
  const int with_nan = count_near(draw_error_plot(broken), series_color(0), 3);
  EXPECT_NEAR(with_nan, 0.6 * whole, 0.06 * whole);
  auto& series = plot.series[0];
  series.times.erase(series.times.begin() + 30, series.times.begin() + 70);
  series.errors.erase(series.errors.begin() + 30, series.errors.begin() + 70);
  EXPECT_NEAR(count_near(draw_error_plot(plot), series_color(0), 3), with_nan, 0.06 * whole);
}

TEST(ErrorPlot, NothingIsClippedLinearOrLogarithmic) {
  for (const bool log_scale : {false, true}) {
    for (const cv::Size size : {cv::Size(400, 0), cv::Size(400, 300), cv::Size(1600, 500)}) {
      ErrorPlot plot = two_curves(size);
      plot.log_scale = log_scale;
      plot.title = "a title that is longer than what fits into the width of such a narrow page";
      plot.series[1].name = "a method with a name that does not fit into the legend of the page at all";
      plot.words = "absolute error of the position";
      plot.series[1].errors[50] = 3.0;
      const cv::Mat3b image = draw_error_plot(plot);
      EXPECT_TRUE(margins_are_white(image, 1)) << size << log_scale;
      EXPECT_TRUE(same_bytes(image, draw_error_plot(plot)));
    }
  }
}

TEST(ErrorPlot, AFewTinyErrorsDoNotStretchALogarithmicScale) {
  ErrorPlot plot = two_curves({800, 0});
  plot.log_scale = true;
  plot.series[0].errors.assign(100, 0.001);
  const cv::Rect body(200, 90, 550, 290);  // without the legend
  const auto height_of_second = [&] { return center_of(draw_error_plot(plot)(body), series_color(1), 3).y; };
  const double whole = height_of_second();
  plot.series[0].errors[0] = 1e-7;
  EXPECT_NEAR(height_of_second(), whole, 2.0);
}

TEST(ErrorPlot, EmptyAndTiny) {
  ErrorPlot plot;
  plot.size = {200, 100};
  EXPECT_FALSE(ink_box(draw_error_plot(plot)).empty());
  plot.series.push_back({"nothing", {}, {}});
  plot.series.push_back({"one", {5.0}, {0.0}});
  plot.log_scale = true;
  EXPECT_EQ(draw_error_plot(plot).size(), cv::Size(200, 100));
  for (const cv::Size size : {cv::Size(16, 16), cv::Size(40, 30), cv::Size(3000, 2000)}) {
    ErrorPlot curves = two_curves(size);
    EXPECT_EQ(draw_error_plot(curves).size(), size);
  }
  plot.series[0].times = {1.0};
  EXPECT_THROW(draw_error_plot(plot), InputError);
}

}  // namespace
}  // namespace odosplat
