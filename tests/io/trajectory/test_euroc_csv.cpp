// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/euroc_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using testing::HasSubstr;

const std::string heading17 =
    "#timestamp, p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m "
    "s^-1], v_RS_R_y [m s^-1], v_RS_R_z [m s^-1], b_w_RS_S_x [rad s^-1], b_w_RS_S_y [rad s^-1], b_w_RS_S_z [rad s^-1], "
    "b_a_RS_S_x [m s^-2], b_a_RS_S_y [m s^-2], b_a_RS_S_z [m s^-2]\r\n";
const std::string row8 = "1403636580838555648,1,2,3,0,0,0,1";  // half a turn about z
const std::string rest9 = ",0.1,0.2,0.3,1e-3,-0.01,0.07,-0.02,0.1,0.2";

void expect_pose(const StampedPose& pose, const Eigen::Vector4d& xyzw) {
  EXPECT_NEAR(pose.time, 1403636580.838555648, 1e-6);
  EXPECT_EQ(pose.stamp(), "1403636580.838555648");
  EXPECT_EQ(pose.T_world_camera.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((pose.T_world_camera.rotation().coeffs() - xyzw).norm(), 1e-12);
}

TEST(EurocCsv, BothTablesHaveWFirstAndNanoseconds) {
  for (const std::string& text :
       {heading17 + row8 + rest9 + "\r\n", row8 + rest9 + "\n", row8 + "\n",
        "#timestamp [ns], x, y, z, w, ...\n" + row8, "\xEF\xBB\xBF" + heading17 + row8 + rest9}) {
    const PoseFile file = parse_pose_file("t.csv", text);
    EXPECT_EQ(file.stamps, StampKind::times);
    ASSERT_EQ(file.poses.size(), 1U) << text;
    expect_pose(file.poses[0], {0, 0, 1, 0});
  }
}

TEST(EurocCsv, SimulatedClocksStartAtZero) {
  const Trajectory t = parse_trajectory("t", "#t [ns],px,py,pz,qw,qx,qy,qz\n0,0,0,0,1,0,0,0\n50000000,1,0,0,1,0,0,0\n");
  ASSERT_EQ(t.size(), 2U);
  EXPECT_EQ(t[1].time, 0.05);
  EXPECT_EQ(t[1].stamp(), "0.050000000");
}

TEST(EurocCsv, AHeadingThatNamesTheQuaternionCounts) {
  const std::string heading = "#time [ns], px, py, pz, qx, qy, qz, qw\n";
  expect_pose(parse_trajectory("t", heading + "1403636580838555648,1,2,3,0,0,0,1")[0], {0, 0, 0, 1});
}

TEST(EurocCsv, OtherTablesKeepTheirMeaning) {
  // TUM's format with commas, and with nanoseconds as some trackers write it: the quaternion is x y z w.
  for (const std::string text : {"1.5,1,2,3,0,0,0,1", "1403636580838555648 1 2 3 0 0 0 1"}) {
    EXPECT_FALSE(is_euroc_csv(text));
    EXPECT_EQ(parse_trajectory("t", text)[0].T_world_camera.rotation().w(), 1.0);
  }
  EXPECT_FALSE(is_euroc_csv(""));
  EXPECT_FALSE(is_euroc_csv(heading17));
}

TEST(EurocCsv, FaultsNameTheLine) {
  const auto fault = [](const std::string& text) { return error_of([&] { parse_trajectory("t.csv", text); }); };
  const std::string good = row8 + rest9 + "\n";
  EXPECT_EQ(fault(good + row8 + "\n"), "t.csv: line 2: has 8 values, the lines before have 17");
  EXPECT_EQ(fault(good + "1403636580838555647,1,2,3,0,0,0,1" + rest9),
            "t.csv: line 2: time 1403636580838555647 is before 1403636580838555648");
  EXPECT_EQ(fault(good + "soon,1,2,3,0,0,0,1" + rest9), "t.csv: line 2: `soon` is not a time in whole nanoseconds");
  EXPECT_THAT(fault(good + "1403636580838555649,1,2,x,0,0,0,1" + rest9), HasSubstr("line 2: `x` is not a number"));
  EXPECT_THAT(fault(good + "1403636580838555649,1,2,3,0,0,0,0" + rest9), HasSubstr("line 2: the quaternion"));
}

}  // namespace
}  // namespace odosplat
