// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/color_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace odosplat {
namespace {

TEST(ColorScale, LightnessIsLinear) {
  // Rounding to 8 bits changes L* by up to about half a unit.
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0;
    EXPECT_NEAR(lightness(scale_color(ColorScale::depth, t)), 12.0 + 80.0 * t, 0.7) << t;
    EXPECT_NEAR(lightness(scale_color(ColorScale::error, t)), 95.0 - 80.0 * t, 0.7) << t;
  }
}

TEST(ColorScale, HasNoKinks) {
  for (const ColorScale scale : {ColorScale::depth, ColorScale::error}) {
    for (int i = 0; i < 256; ++i) {
      const Rgb a = scale_color(scale, i / 256.0);
      const Rgb b = scale_color(scale, (i + 1) / 256.0);
      for (int c = 0; c < 3; ++c) EXPECT_LE(std::abs(a[c] - b[c]), 9) << i;
    }
  }
}

TEST(ColorScale, ClampsAndTakesNanAsLow) {
  for (const ColorScale scale : {ColorScale::depth, ColorScale::error}) {
    EXPECT_EQ(scale_color(scale, -3.0), scale_color(scale, 0.0));
    EXPECT_EQ(scale_color(scale, 7.0), scale_color(scale, 1.0));
    EXPECT_EQ(scale_color(scale, std::numeric_limits<double>::quiet_NaN()), scale_color(scale, 0.0));
  }
}

TEST(ColorScale, NeverLooksLikeTheHatching) {
  for (const ColorScale scale : {ColorScale::depth, ColorScale::error}) {
    for (int i = 0; i <= 1000; ++i) {
      const Rgb c = scale_color(scale, i / 1000.0);
      const int spread = std::max({c[0], c[1], c[2]}) - std::min({c[0], c[1], c[2]});
      EXPECT_GT(spread, 12) << i;  // the hatching's greys have 0
    }
  }
  EXPECT_EQ(hatch_light[0], hatch_light[2]);
  EXPECT_EQ(hatch_dark[0], hatch_dark[2]);
}

TEST(Lightness, OfKnownColors) {
  EXPECT_NEAR(lightness({0, 0, 0}), 0.0, 1e-9);
  EXPECT_NEAR(lightness({255, 255, 255}), 100.0, 1e-4);
  EXPECT_NEAR(lightness({119, 119, 119}), 50.03, 0.02);  // sRGB 119 is the textbook's mid grey
  EXPECT_NEAR(lightness({255, 0, 0}), 53.24, 0.02);
}

TEST(SeriesColor, DiffersInGreyToo) {
  std::set<int> seen;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GT(std::abs(lightness(series_color(i)) - lightness(series_color(j))), 8.0) << i << " " << j;
    }
  }
  EXPECT_EQ(series_color(0), series_color(7));
}

TEST(Hatch, HasBothGreysAtEveryPitch) {
  for (int pitch = 0; pitch < 12; ++pitch) {
    int dark = 0;
    int light = 0;
    for (int x = 0; x < 24; ++x) (hatch_color(x, 3, pitch) == hatch_dark ? dark : light)++;
    EXPECT_GT(dark, 0);
    EXPECT_GT(light, 0);
  }
}

}  // namespace
}  // namespace odosplat
