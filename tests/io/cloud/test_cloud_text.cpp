// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/io/cloud/cloud_file.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using Eigen::Vector3f;
using test::error_of;
using testing::HasSubstr;

PointCloud read(const std::string& text, const std::string& name = "c.txt") { return parse_point_cloud(name, text); }

std::string fault(const std::string& text) {
  return error_of([&] { read(text); });
}

TEST(CloudText, SeparatorsAndLineEnds) {
  for (const char* text : {"1 2 3\n4 5 6\n", "1\t2\t3\r\n4\t5\t6\r\n", "1,2,3\n4,5,6", "1; 2; 3\n\n4;5;6;\n",
                           "  1   2 +3\n4 5 6e0  \n", "# a comment\n1 2 3\n// another\n4 5 6\n", "2\n1 2 3\n4 5 6\n",
                           "x,y,z\n1,2,3\n4,5,6\n", "\"X\" \"Y\" \"Z\"\n1 2 3\n4 5 6\n", "//X Y Z\n1 2 3\n4 5 6\n"}) {
    SCOPED_TRACE(text);
    const PointCloud cloud = read(text);
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.points[0], Vector3f(1, 2, 3));
    EXPECT_EQ(cloud.points[1], Vector3f(4, 5, 6));
    EXPECT_FALSE(cloud.has_colors());
    EXPECT_FALSE(cloud.has_normals());
  }
}

TEST(CloudText, NamesMayStandInAnyOrder) {
  const PointCloud cloud =
      read("intensity;B;G;R;z;y;x;Nx;Ny;Nz\n77;51;0;255;3;2;1;0;0;2\n77;51;0;255;6;5;4;0;1;0\n", "c.csv");
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.points[1], Vector3f(4, 5, 6));
  EXPECT_LT((cloud.colors.at(0) - Vector3f(1.0F, 0.0F, 0.2F)).norm(), 1e-6F);
  EXPECT_EQ(cloud.normals.at(0), Vector3f(0, 0, 1));
  const PointCloud red = read("// x y z red green blue\n1 2 3 1 0 0.2\n", "c.xyz");
  EXPECT_LT((red.colors.at(0) - Vector3f(1.0F, 0.0F, 0.2F)).norm(), 1e-6F);
}

TEST(CloudText, ColoursAreOver255IfAnyIsAboveOne) {
  // The value above 1 may come late, after the first batch.
  std::string text;
  for (int i = 0; i < 70000; ++i) text += "1 2 3 1 0 0\n";
  EXPECT_EQ(read("x y z r g b\n" + text).colors.at(0), Vector3f(1, 0, 0));
  const PointCloud cloud = read("x y z r g b\n" + text + "1 2 3 255 0 0\n");
  EXPECT_EQ(cloud.colors.at(0), Vector3f(1.0F / 255.0F, 0, 0));
  EXPECT_EQ(cloud.colors.back(), Vector3f(1, 0, 0));
}

TEST(CloudText, NamedColoursAre16BitsIfAnyIsAbove255) {
  const PointCloud cloud =
      read("\"X\",\"Y\",\"Z\",\"Red\",\"Green\",\"Blue\"\n1,2,3,65535,0,13107\n4,5,6,200,0,0\n", "c.csv");
  EXPECT_LT((cloud.colors.at(0) - Vector3f(1.0F, 0.0F, 0.2F)).norm(), 1e-6F);
  EXPECT_NEAR(cloud.colors.at(1).x(), 200.0F / 65535.0F, 1e-7F);
}

// Values of 0..1 that exceed 1 by rounding.
TEST(CloudText, ColoursOfUnitRangeMayOvershootALittle) {
  EXPECT_EQ(read("x y z r g b\n1 2 3 1.0002 0.5 0\n").colors.at(0), Vector3f(1.0F, 0.5F, 0.0F));
}

TEST(CloudText, ByteOrderMarksArePassedOver) {
  const PointCloud named = read("\xEF\xBB\xBFx,y,z,r,g,b\n1,2,3,255,0,51\n", "c.csv");
  ASSERT_EQ(named.size(), 1U);
  EXPECT_TRUE(named.has_colors());
  EXPECT_EQ(read("\xEF\xBB\xBF"
                 "1 2 3\n4 5 6\n")
                .size(),
            2U);
  EXPECT_EQ(read("\xEF\xBB\xBF# comment\n1 2 3\n").size(), 1U);
  EXPECT_EQ(fault(std::string("\xFF\xFE"
                              "1\0 \0",
                              6)),
            "c.txt: is a text in UTF-16; save it as UTF-8");
}

TEST(CloudText, ColumnsWithoutNames) {
  EXPECT_FALSE(read("1 2 3 99\n").has_colors());
  EXPECT_EQ(read("1 2 3 255 0 0\n").colors.at(0), Vector3f(1, 0, 0));
  EXPECT_EQ(read("1 2 3 0.6 -0.8 0\n4 5 6 0 0 1\n").normals.at(1), Vector3f(0, 0, 1));
  EXPECT_EQ(read("1\n1 2 3 -500 255 0 0\n", "c.pts").colors.at(0), Vector3f(1, 0, 0));
  const PointCloud all = read("1 2 3 255 0 0 0 0 1\n");
  EXPECT_TRUE(all.has_colors());
  EXPECT_TRUE(all.has_normals());
}

TEST(CloudText, WhatCannotBeToldIsRefused) {
  const std::string hint = "; begin the file with a line of names, as in `x y z r g b`";
  EXPECT_EQ(fault("1 2 3 0 0 1\n"), "c.txt: line 1: has columns that may be colours or normals" + hint);
  for (const char* columns : {"1 2", "1 2 3 4 5", "1 2 3 4 5 6 7", "1 2 3 4 5 6 7 8", "1 2 3 4 5 6 7 8 9 10"}) {
    EXPECT_THAT(fault(columns), HasSubstr("columns without names" + hint));
  }
}

TEST(CloudText, FaultsNameTheLine) {
  EXPECT_EQ(fault("1 2 3\n# x\n1 2\n"), "c.txt: line 3: has 2 values, must have 3");
  EXPECT_EQ(fault("1 2 3\n1 2 3 4\n"), "c.txt: line 2: has 4 values, must have 3");
  EXPECT_EQ(fault("x y z i\n1 2 3\n"), "c.txt: line 2: has 3 values, must have 4");
  EXPECT_EQ(fault("1 2 3\n1 two 3\n"), "c.txt: line 2: `two` is not a number");
  EXPECT_EQ(fault("1 2 3\n1 1e999 3\n"), "c.txt: line 2: `1e999` is not a number");
  EXPECT_EQ(fault("1,5;2,5;3,5\n"), "c.txt: line 1: neither holds numbers nor names columns x y z: `1,5;2,5;3,5`");
  EXPECT_EQ(fault("1 2 3 4 5 300\n"), "c.txt: line 1: its colour is not in 0..255 or 0..1");
  EXPECT_EQ(fault("x y z r g b\n1 2 3 4 5 -1\n"), "c.txt: line 2: its colour is not in 0..65535, 0..255 or 0..1");
  EXPECT_EQ(fault("x y z r g b\n1 2 3 4 5 65536\n"), "c.txt: line 2: its colour is not in 0..65535, 0..255 or 0..1");
  EXPECT_EQ(fault("east north up\n1 2 3\n"),
            "c.txt: line 1: neither holds numbers nor names columns x y z: `east north up`");
  EXPECT_EQ(fault("# nothing\n"), "c.txt: holds no point");
  EXPECT_EQ(fault(""), "c.txt: holds no point");
  EXPECT_EQ(fault("nan nan nan\n"), "c.txt: holds no point");
  EXPECT_EQ(fault(std::string(70000, '1')), "c.txt: line 1: is longer than a line of text can be");
}

TEST(CloudText, PointsBeyondSinglePrecisionAreLeftOutAndCounted) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(read("1 2 3\n1 1e30 3\n-1e38 2 3\n").size(), 1U);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("2 of 3 points are not finite or 1e15 m and more from the origin, and left out"));
}

TEST(CloudText, PointsThatAreNotFiniteAreLeftOut) {
  const PointCloud cloud = read("1 2 3 4 5 6\nnan 2 3 4 5 6\n7 8 9 250 5 6\n");
  ASSERT_EQ(cloud.size(), 2U);
  ASSERT_EQ(cloud.colors.size(), 2U);
  EXPECT_EQ(cloud.points[1], Vector3f(7, 8, 9));
}

}  // namespace
}  // namespace odosplat
