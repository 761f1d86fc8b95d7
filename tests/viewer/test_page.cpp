// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/page.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "odosplat/core/error.hpp"
#include "tests/viewer/figure_checks.hpp"
#include "viewer/text.hpp"

namespace odosplat {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Text, IsInkOfTheWidthItClaims) {
  const cv::Mat1b ink = text_ink("Agy 0.5", 40);
  ASSERT_FALSE(ink.empty());
  EXPECT_EQ(ink.cols, text_width("Agy 0.5", 40));
  EXPECT_NEAR(ink.rows, 40, 6);
  EXPECT_GT(cv::countNonZero(ink), 300);
}

TEST(Text, GrowsWithItsSize) {
  EXPECT_NEAR(text_width("trajectory", 80), 2 * text_width("trajectory", 40), 6);
  EXPECT_EQ(text_width("", 40), 0);
  EXPECT_TRUE(text_ink("", 40).empty());
  EXPECT_TRUE(text_ink("   ", 40).empty());
}

TEST(Text, DrawsOneMarkForACharacterOutsideItsFont) {
  EXPECT_EQ(text_width("5 \xC2\xB5m", 40), text_width("5 ?m", 40));
}

TEST(FitText, ShrinksThenCuts) {
  const std::string text = "a rather long title";
  const int full = text_width(text, 40);
  const FittedText same = fit_text(text, 40, full);
  EXPECT_EQ(same.text, text);
  EXPECT_EQ(same.size, 40);
  const FittedText smaller = fit_text(text, 40, 0.8 * full);
  EXPECT_EQ(smaller.text, text);
  EXPECT_LT(smaller.size, 40);
  EXPECT_LE(text_width(smaller.text, smaller.size), 0.8 * full);
  const FittedText cut = fit_text(text, 40, 0.4 * full);
  EXPECT_TRUE(cut.text.ends_with("..."));
  EXPECT_EQ(cut.size, 28);
  EXPECT_LE(text_width(cut.text, cut.size), 0.4 * full);
  EXPECT_EQ(fit_text(text, 40, 0.0).text, "");
}

TEST(Page, TextStandsWhereAsked) {
  Page page({400, 200});
  page.text("left", {50.0, 100.0}, {.size = 30.0});
  EXPECT_NEAR(ink_box(page.pixels()).x, 50, 4);
  EXPECT_NEAR(ink_box(page.pixels()).y + ink_box(page.pixels()).height / 2, 100, 3);
  Page right({400, 200});
  right.text("right", {350.0, 100.0}, {.size = 30.0, .x = AlignX::right, .y = AlignY::bottom});
  EXPECT_NEAR(ink_box(right.pixels()).br().x, 350, 4);
  EXPECT_LE(ink_box(right.pixels()).br().y, 100);
  Page upright({400, 200});
  upright.text("middle", {200.0, 100.0}, {.size = 30.0, .x = AlignX::center, .vertical = true});
  const cv::Rect box = ink_box(upright.pixels());
  EXPECT_GT(box.height, 2 * box.width);
  EXPECT_NEAR(box.y + box.height / 2, 100, 3);
}

TEST(Page, DrawingOutsideIsCutOff) {
  Page page({40, 30});
  page.text("far too long for this page", {-20.0, 15.0}, {.size = 30.0}, true);
  page.line({-1e9, -5.0}, {1e9, 50.0}, 3.0, {1, 2, 3});
  page.dashed({{-100.0, 0.0}, {100.0, 20.0}}, 2.0, {1, 2, 3}, 0.0);
  page.fill({-10.0, -10.0, 500.0, 15.0}, {9, 9, 9});
  page.frame({30.0, 20.0, 50.0, 50.0}, 2.0, {9, 9, 9});
  page.disc({45.0, 30.0}, 10.0, {1, 2, 3});
  page.hatch({35.0, 25.0, 50.0, 50.0}, 4);
  page.paste(cv::Mat3b(20, 20, Rgb(7, 7, 7)), {30, -10});
  EXPECT_EQ(page.pixels().size(), cv::Size(40, 30));
  EXPECT_EQ(page.pixels()(5, 35), Rgb(7, 7, 7));
}

TEST(ValuePanel, FollowsTheScaleAndMarksWhatIsMissing) {
  const cv::Mat1f values = (cv::Mat1f(2, 3) << 1.0F, 2.0F, 3.0F, 0.0F, nan, -1.0F);
  const cv::Mat3b panel = value_panel(values, ColorScale::depth, 1.0, 3.0, {3, 2}, 4, false);
  EXPECT_EQ(panel(0, 0), scale_color(ColorScale::depth, 0.0));
  EXPECT_EQ(panel(0, 1), scale_color(ColorScale::depth, 0.5));
  EXPECT_EQ(panel(0, 2), scale_color(ColorScale::depth, 1.0));
  EXPECT_LT(lightness(panel(0, 0)), lightness(panel(0, 1)));
  EXPECT_LT(lightness(panel(0, 1)), lightness(panel(0, 2)));
  for (int x = 0; x < 3; ++x) EXPECT_TRUE(panel(1, x) == hatch_light || panel(1, x) == hatch_dark) << x;
  const cv::Mat3b with_zero = value_panel(values, ColorScale::error, 0.0, 3.0, {3, 2}, 4, true);
  EXPECT_EQ(with_zero(1, 0), scale_color(ColorScale::error, 0.0));
}

TEST(ValuePanel, RepeatsPixelsWhenItGrows) {
  const cv::Mat1f values = (cv::Mat1f(1, 2) << 1.0F, 3.0F);
  const cv::Mat3b panel = value_panel(values, ColorScale::depth, 1.0, 3.0, {10, 4}, 4, false);
  EXPECT_EQ(count_near(panel, scale_color(ColorScale::depth, 0.0), 0), 20);
  EXPECT_EQ(count_near(panel, scale_color(ColorScale::depth, 1.0), 0), 20);
}

TEST(ColorPanel, KeepsColorsAndClampsThem) {
  ColorImage image(1, 3);
  image(0, 0) = {0.0F, 0.5F, 1.0F};
  image(0, 1) = {-1.0F, 2.0F, nan};
  image(0, 2) = {1.0F, 0.0F, 0.0F};
  const cv::Mat3b panel = color_panel(image, {3, 1});
  EXPECT_EQ(panel(0, 0), Rgb(0, 128, 255));
  EXPECT_EQ(panel(0, 1), Rgb(0, 255, 0));
  EXPECT_EQ(panel(0, 2), Rgb(255, 0, 0));
}

TEST(Tiled, PutsPicturesInRows) {
  const cv::Mat3b red(4, 6, Rgb(255, 0, 0));
  const cv::Mat3b green(2, 3, Rgb(0, 255, 0));
  const cv::Mat3b page = tiled({red, green, green}, 2);
  ASSERT_EQ(page.size(), cv::Size(9, 6));
  EXPECT_EQ(count_near(page(cv::Rect(0, 0, 6, 4)), {255, 0, 0}, 0), 24);
  EXPECT_EQ(count_near(page(cv::Rect(6, 0, 3, 2)), {0, 255, 0}, 0), 6);
  EXPECT_EQ(count_near(page(cv::Rect(0, 4, 3, 2)), {0, 255, 0}, 0), 6);
  EXPECT_EQ(count_near(page, {255, 255, 255}, 0), 54 - 36);
  EXPECT_EQ(tiled({red}, 3).size(), red.size());
  EXPECT_TRUE(tiled({}, 2).empty());
  EXPECT_THROW(tiled({red}, 0), InputError);
}

TEST(FigureSize, FillsInTheHeightAndRefusesNonsense) {
  EXPECT_EQ(figure_size({400, 0}, 0.75), cv::Size(400, 300));
  EXPECT_EQ(figure_size({400, 77}, 0.75), cv::Size(400, 77));
  EXPECT_THROW(figure_size({0, 0}, 0.75), InputError);
  EXPECT_THROW(figure_size({400, -1}, 0.75), InputError);
  EXPECT_THROW(figure_size({20000, 100}, 0.75), InputError);
}

}  // namespace
}  // namespace odosplat
