// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/comparable_stamps.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using testing::HasSubstr;

PoseFile kitti(int n) {
  std::string text;
  for (int k = 0; k < n; ++k) text += "1 0 0 " + std::to_string(k) + " 0 1 0 0 0 0 1 0\n";
  return parse_pose_file("kitti", text);
}
PoseFile tum(int n, const std::string& fraction = ".25") {
  std::string text;
  for (int k = 1; k <= n; ++k) text += std::to_string(k) + fraction + " 0 0 0 0 0 0 1\n";
  return parse_pose_file("tum", text);
}
PoseFile redwood(int n) {
  std::string text;
  for (int k = 0; k < n; ++k) text += std::to_string(7 * k) + " 0 0\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  return parse_pose_file("log", text);
}

void compare(const PoseFile& a, const PoseFile& b) {
  require_comparable_stamps({a, "est.txt", "--times"}, {b, "gt.txt", "--truth-times"});
}
std::string fault(const PoseFile& a, const PoseFile& b) {
  return error_of([&] { compare(a, b); });
}

TEST(ComparableStamps, PosesWithoutTimesMustBeEquallyMany) {
  compare(kitti(5), kitti(5));
  compare(kitti(5), redwood(5));
  EXPECT_EQ(
      fault(kitti(2), kitti(12)),
      "est.txt: holds 2 poses without times, gt.txt 12 poses: which of them belong together is not known; name the "
      "times of both (--times, --truth-times)");
  EXPECT_THAT(fault(redwood(3), kitti(4)), HasSubstr("which of them belong together is not known"));
}

TEST(ComparableStamps, NumbersOfFramesAreTold) {
  compare(redwood(3), redwood(5));
  compare(redwood(3), tum(5, ""));
  compare(tum(3, ".000"), redwood(5));
}

TEST(ComparableStamps, TimesAndNoTimesAreNotCompared) {
  compare(tum(3), tum(50));
  EXPECT_EQ(fault(kitti(5), tum(5)), "est.txt: has no times, gt.txt has: name its times (--times)");
  EXPECT_EQ(fault(tum(5), kitti(5)), "gt.txt: has no times, est.txt has: name its times (--truth-times)");
  EXPECT_EQ(fault(tum(5), redwood(5)), "gt.txt: has no times, est.txt has: name its times (--truth-times)");
  EXPECT_THAT(fault(tum(5, ""), kitti(5)), HasSubstr("has no times")) << "line numbers are no numbers of frames";
}

TEST(ComparableStamps, ASecondFileGivesTimes) {
  const test::TempFolder temp;
  const std::string poses = temp.put("p.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_EQ(read_pose_file(poses).stamps, StampKind::line_numbers);
  EXPECT_EQ(read_pose_file(poses, temp.put("t.txt", "3.5\n")).stamps, StampKind::times);
}

}  // namespace
}  // namespace odosplat
