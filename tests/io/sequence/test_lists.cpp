// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "odosplat/io/sequence/layout_parts.hpp"
#include "odosplat/io/text/list_file.hpp"
#include "odosplat/io/text/natural_order.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Pair;

TEST(NaturalOrder, NumbersCompareAsNumbers) {
  std::vector<std::string> names{"10.png",
                                 "2.png",
                                 "1.png",
                                 "a10b3",
                                 "a10b20",
                                 "a9b100",
                                 "b",
                                 "A",
                                 "01.png",
                                 "001.png",
                                 "",
                                 "9",
                                 "99999999999999999999999",
                                 "100000000000000000000000"};
  std::sort(names.begin(), names.end(), natural_less);
  EXPECT_THAT(names, ElementsAre("", "001.png", "01.png", "1.png", "2.png", "9", "10.png", "99999999999999999999999",
                                 "100000000000000000000000", "A", "a9b100", "a10b3", "a10b20", "b"));
}

TEST(NaturalOrder, IsAStrictTotalOrder) {
  const std::vector<std::string> names{"",    "0",   "00",   "1",    "01", "1a",  "a",    "a1",
                                       "a01", "a1b", "a01b", "a1b0", "ab", "1.1", "1.01", "10"};
  for (const std::string& a : names) {
    for (const std::string& b : names) {
      EXPECT_EQ(natural_less(a, b) + natural_less(b, a), a == b ? 0 : 1) << a << " " << b;
      for (const std::string& c : names) {
        if (natural_less(a, b) && natural_less(b, c)) {
          EXPECT_TRUE(natural_less(a, c)) << a << " " << b << " " << c;
        }
      }
    }
  }
}

TEST(NaturalOrder, FindsTheLastNumberOfAName) {
  EXPECT_EQ(number_in("frame-000012"), 12);
  EXPECT_EQ(number_in("kt3_0007_rgb"), 7);
  EXPECT_EQ(number_in("0"), 0);
  EXPECT_EQ(number_in("none"), -1);
  EXPECT_EQ(number_in(""), -1);
  EXPECT_EQ(number_in("1234567890123456"), -1);
}

TEST(ImageList, ReadsTumLists) {
  const auto list = parse_image_list("l", "# c\n0.5 rgb/a b.png\r\n\n 1305031249.529692\trgb/2.png  ");
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].path, "rgb/a b.png");
  EXPECT_EQ(list[0].line, 2U);
  EXPECT_EQ(list[1].time_text, "1305031249.529692");
  EXPECT_EQ(list[1].path, "rgb/2.png");
  EXPECT_THAT(parse_image_list("l", ""), IsEmpty());
}

TEST(ImageList, FaultsAreNamed) {
  EXPECT_EQ(error_of([] { parse_image_list("l", "1 a\nx b\n"); }), "l: line 2: `x` is not a number");
  EXPECT_EQ(error_of([] { parse_image_list("l", "nan a\n"); }), "l: line 1: `nan` is not a number");
  EXPECT_EQ(error_of([] { parse_image_list("l", "1\n"); }), "l: line 1: names no file");
  EXPECT_EQ(error_of([] { parse_image_list("l", "1 a\n1 b\n"); }), "l: line 2: time 1 is not after 1");
}

TEST(PairList, DepthIsFirstUnlessNamesSayOtherwise) {
  const auto official = parse_pair_list("l", "0 depth/0.png 3 rgb/3.png\n");
  EXPECT_EQ(official.at(0).depth_path, "depth/0.png");
  EXPECT_EQ(official.at(0).color_path, "rgb/3.png");
  EXPECT_EQ(official.at(0).color_id, 3.0);
  const auto turned = parse_pair_list("l", "3 rgb/3.png 0 depth/0.png\n");
  EXPECT_EQ(turned.at(0).depth_path, "depth/0.png");
  EXPECT_EQ(turned.at(0).color_id, 3.0);
  EXPECT_EQ(parse_pair_list("l", "1 a.png 1 b.png\n").at(0).depth_path, "a.png");
}

TEST(PairList, NamesOfImagesMayHoldBlanks) {
  const auto pairs = parse_pair_list("l", "1.5 rgb/a  1.png 1.25 depth/a 1.PNG\n2.5 rgb/b.png 2.25 depth/b.png\n");
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].color_path, "rgb/a  1.png");
  EXPECT_EQ(pairs[0].depth_path, "depth/a 1.PNG");
  EXPECT_EQ(pairs[0].depth_id, 1.25);
  EXPECT_EQ(pairs[0].color_text, "1.5");
  EXPECT_TRUE(pairs[0].has_times());
  EXPECT_FALSE(parse_pair_list("l", "1 d 1 c\n").at(0).has_times());
  EXPECT_THAT(error_of([] { parse_pair_list("l", "1 d 1 c 5\n"); }), HasSubstr("l: line 1: has more than"));
}

TEST(ImageList, AByteOrderMarkIsPassedOver) {
  EXPECT_EQ(parse_image_list("l",
                             "\xEF\xBB\xBF"
                             "1.5 a.png\n")
                .at(0)
                .time,
            1.5);
  EXPECT_EQ(parse_image_list("l", "1.5 a  b c.png\n").at(0).path, "a  b c.png");
}

TEST(PairList, FaultsAreNamed) {
  EXPECT_THAT(error_of([] { parse_pair_list("l", "0 depth/0.png 0\n"); }), HasSubstr("l: line 1: expected"));
  EXPECT_THAT(error_of([] { parse_pair_list("l", "0 depth/0.png rgb/0.png 0\n"); }),
              HasSubstr("l: line 1: `rgb/0.png`"));
  EXPECT_THAT(error_of([] { parse_pair_list("l", "1 d 1 c\n1 d 1 c\n"); }), HasSubstr("l: line 2: ids do not grow"));
}

TEST(Association, TakesNearestPairsFirstAndEachOnce) {
  EXPECT_THAT(associate_by_time({0.0, 0.033, 0.066}, {0.001, 0.031, 0.064}, 0.02),
              ElementsAre(Pair(0, 0), Pair(1, 1), Pair(2, 2)));
  // 0.010 is within the limit of both and nearer to the second; the first gets no partner.
  EXPECT_THAT(associate_by_time({0.0, 0.012}, {0.010}, 0.02), ElementsAre(Pair(1, 0)));
  EXPECT_THAT(associate_by_time({0.0}, {0.021}, 0.02), IsEmpty());
  EXPECT_THAT(associate_by_time({}, {1.0}, 0.02), IsEmpty());
  EXPECT_THAT(associate_by_time({1.0}, {}, 0.02), IsEmpty());
}

TEST(PoseAtTime, EqualElseBetweenElseNearest) {
  const auto at = [](double t, double x) { return StampedPose{t, SE3(Eigen::Quaterniond::Identity(), {x, 0, 0}), ""}; };
  const Trajectory t{at(1.0, 1), at(1.05, 2), at(2.0, 10)};
  const auto x = [&](double time) {
    const auto pose = pose_at(t, time);
    return pose ? pose->translation().x() : -1.0;
  };
  EXPECT_EQ(x(1.0), 1.0);
  EXPECT_EQ(x(1.05 + 4e-7), 2.0);
  EXPECT_NEAR(x(1.02), 1.4, 1e-9);  // interpolated
  EXPECT_EQ(x(1.055), 2.0);         // the interval 1.05 .. 2.0 is too long to interpolate: nearest pose
  EXPECT_EQ(x(1.07), -1.0);
  EXPECT_EQ(x(1.995), 10.0);
  EXPECT_EQ(x(2.009), 10.0);  // after the last pose
  EXPECT_EQ(x(2.02), -1.0);
  EXPECT_EQ(x(0.995), 1.0);
  EXPECT_EQ(x(0.9), -1.0);
  EXPECT_FALSE(pose_at({}, 1.0));
}

}  // namespace
}  // namespace odosplat
