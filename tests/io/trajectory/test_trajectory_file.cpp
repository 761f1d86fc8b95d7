// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/locations.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "odosplat/core/random.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

SE3 random_pose(Random& random) {
  Vector6d xi;
  for (int i = 0; i < 6; ++i) xi[i] = random.uniform(-2.0, 2.0);
  return SE3::exp(xi);
}

double distance(const SE3& a, const SE3& b) { return (a.inverse() * b).log().norm(); }

TEST(TrajectoryFile, ReadsTumWithCommentsBlanksAndCarriageReturns) {
  const Trajectory t =
      parse_trajectory("t", "# time ...\r\n\r\n1.50 1 2 3 0 0 0 2\r\n   \n  # more\n2.5\t-1 0 0 0 0 1 0");
  ASSERT_EQ(t.size(), 2U);
  EXPECT_EQ(t[0].time, 1.5);
  EXPECT_EQ(t[0].time_text, "1.50");
  EXPECT_EQ(t[0].T_world_camera.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(t[0].T_world_camera.rotation().w(), 1.0);  // normalised
  EXPECT_LT(distance(t[1].T_world_camera, SE3(so3_exp({0, 0, M_PI}), Eigen::Vector3d(-1, 0, 0))), 1e-12);
}

TEST(TrajectoryFile, RoundTripKeepsStampsAndNineDecimals) {
  const TempFolder temp;
  Random random(3);
  Trajectory written;
  for (int i = 0; i < 50; ++i) written.push_back({1305031225.0 + 0.1 * i, random_pose(random), ""});
  written[7].time_text = "1305031225.7";
  write_trajectory(temp / "t.txt", written);
  const Trajectory read = read_trajectory(temp / "t.txt");
  ASSERT_EQ(read.size(), written.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_NEAR(read[i].time, written[i].time, 1e-6);
    EXPECT_EQ(read[i].time_text, i == 7 ? "1305031225.7" : written[i].stamp());
    EXPECT_LT(distance(read[i].T_world_camera, written[i].T_world_camera), 1e-8);
  }
}

TEST(TrajectoryFile, EmptyTrajectoryIsACommentLine) {
  const TempFolder temp;
  write_trajectory(temp / "t.txt", {});
  EXPECT_EQ(read_file(temp / "t.txt")[0], '#');
  EXPECT_EQ(error_of([&] { read_trajectory(temp / "t.txt"); }), temp / "t.txt" + ": holds no pose");
}

TEST(TrajectoryFile, ReadsMatricesOfEveryShape) {
  // A rotation by 90 degrees about z and a translation by (1, 2, 3).
  const SE3 expected(so3_exp({0, 0, M_PI / 2}), Eigen::Vector3d(1, 2, 3));
  const std::string rows3 = "0 -1 0 1\n1 0 0 2\n0 0 1 3\n";
  const std::string flat12 = "0 -1 0 1 1 0 0 2 0 0 1 3";
  const Trajectory kitti = parse_trajectory("t", flat12 + "\n" + flat12 + "\n");
  ASSERT_EQ(kitti.size(), 2U);
  EXPECT_EQ(kitti[1].time, 1.0);
  EXPECT_LT(distance(kitti[1].T_world_camera, expected), 1e-12);
  const Trajectory replica = parse_trajectory("t", flat12 + " 0 0 0 1\n");
  EXPECT_LT(distance(replica[0].T_world_camera, expected), 1e-12);
  const Trajectory log = parse_trajectory("t", "4 4 5\n" + rows3 + "0 0 0 1\n7 7 8\n" + rows3 + "0 0 0 1\n");
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log[1].time, 7.0);
  EXPECT_LT(distance(log[1].T_world_camera, expected), 1e-12);
  const Trajectory sim = parse_trajectory("t", rows3 + "\n" + rows3 + "\n");
  ASSERT_EQ(sim.size(), 2U);
  EXPECT_LT(distance(sim[1].T_world_camera, expected), 1e-12);
  EXPECT_LT(distance(parse_pose_matrix("t", rows3 + "0 0 0 1").value(), expected), 1e-12);
}

TEST(TrajectoryFile, TakesTimesFromASecondFile) {
  const TempFolder temp;
  const std::string pose = "1 0 0 0 0 1 0 0 0 0 1 0\n";
  const std::string poses = temp.put("p.txt", pose + pose);
  const Trajectory t = read_trajectory(poses, temp.put("times.txt", "0.000000e+00\n1.037e-01\n"));
  EXPECT_EQ(t[1].time, 0.1037);
  EXPECT_EQ(t[1].time_text, "1.037e-01");
  EXPECT_THAT(error_of([&] { read_trajectory(poses, temp.put("one.txt", "0\n")); }),
              HasSubstr("one.txt: holds 1 times for 2 poses"));
  EXPECT_THAT(error_of([&] { read_trajectory(poses, temp.put("back.txt", "1\n0\n")); }), HasSubstr("back.txt: line 2"));
}

struct Fault {
  const char* text;
  const char* message;
};

class TrajectoryFault : public testing::TestWithParam<Fault> {};

TEST_P(TrajectoryFault, NamesFileAndLine) {
  EXPECT_EQ(error_of([] { parse_trajectory("t.txt", GetParam().text); }), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, TrajectoryFault,
    testing::Values(Fault{"", "t.txt: holds no pose"}, Fault{"# nothing\n\n", "t.txt: holds no pose"},
                    Fault{"1 0 0 0 0 0 0 1\nnan 0 0 0 0 0 0 1\n", "t.txt: line 2: `nan` is not finite"},
                    Fault{"1 0 0 -inf 0 0 0 1\n", "t.txt: holds no pose that is finite"},
                    Fault{"inf 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n", "t.txt: line 1: `inf` is not finite"},
                    Fault{"\xFF\xFE"
                          "1",
                          "t.txt: is a text in UTF-16; save it as UTF-8"},
                    Fault{"# c\n1 0 0 0 0 0 0 one\n", "t.txt: line 2: `one` is not a number"},
                    Fault{"1 0 0 0 0 0 0 1e999\n", "t.txt: line 1: `1e999` is not a number"},
                    Fault{"1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n", "t.txt: line 2: has 7 values, the lines before have 8"},
                    Fault{"1 0 0 0 0 0 1\n", "t.txt: line 1: has 7 values; a pose has 8 (TUM), 12 (KITTI) or 16"},
                    Fault{"1 0 0 0 0 0 0 0\n", "t.txt: line 1: the quaternion has length 0, must be near 1 (0.5..2)"},
                    Fault{"1 0 0 0 0 0 0 3\n", "t.txt: line 1: the quaternion has length 3, must be near 1 (0.5..2)"},

                    Fault{"2 0 0 0 0 0 0 1\n\n1 0 0 0 0 0 0 1\n", "t.txt: line 3: time 1 is before 2"},
                    Fault{"1 0 0 0 0 2 0 0 0 0 1 0\n", "t.txt: line 1: the matrix is no rotation"},
                    Fault{"1 0 0 0 0 1 0 0 0 0 -1 0\n", "t.txt: line 1: the matrix is no rotation"},
                    Fault{"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n", "t.txt: line 4: the last matrix is not complete"},
                    Fault{"0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1\n0 0 0 1\n",
                          "t.txt: line 4: expected the 4 values of a matrix row"},
                    Fault{"0 0 1\n", "t.txt: line 1: the last matrix is not complete"},
                    Fault{"1 0 0 0\n0 1 0 0\n0 0 1 0\n1 0 0 0\n", "t.txt: line 4: the last matrix is not complete"}));

// As in TUM's own freiburg2_desk.
TEST(TrajectoryFile, TwoPosesMayHaveOneStamp) {
  EXPECT_EQ(parse_trajectory("t", "1 0 0 0 0 0 0 1\n1 1 0 0 0 0 0 1\n").size(), 2U);
}

TEST(TrajectoryFile, RefusesAnIncompletePoseMatrix) {
  EXPECT_THAT(error_of([] { parse_pose_matrix("p", "1 0 0 0\n0 1 0 0\n0 0 1 0\n"); }), HasSubstr("holds 3 lines"));
}

TEST(TrajectoryFile, AMatrixThatIsNotFiniteOrBlankIsNone) {
  const std::string row = "-inf -inf -inf -inf\n";
  EXPECT_FALSE(parse_pose_matrix("p", row + row + row + row));
  EXPECT_FALSE(parse_pose_matrix("p", "1 0 0 0\n0 nan 0 0\n0 0 1 0\n0 0 0 1\n"));
  EXPECT_FALSE(parse_pose_matrix("p", "\n"));
}

TEST(TrajectoryFile, PosesThatAreNotFiniteAreLeftOutAndKeepTheirNumbers) {
  const TempFolder temp;
  const PoseFile tum = read_pose_file(
      temp.put("tum.txt", "1 0 0 0 0 0 0 1\n2 nan nan nan nan nan nan nan\n3 -inf 0 0 0 0 0 1\n4 5 0 0 0 0 0 1\n"));
  ASSERT_EQ(tum.poses.size(), 2U);
  EXPECT_EQ(tum.poses[1].time, 4.0);
  EXPECT_EQ(tum.times_without_pose, (std::vector<double>{2.0, 3.0}));
  EXPECT_EQ(tum.numbers, (std::vector<std::size_t>{0, 3}));
  const std::string pose = "1 0 0 0 0 1 0 0 0 0 1 0";
  const std::string lost = "inf inf inf inf inf inf inf inf inf inf inf inf";
  const std::string kitti = temp.put("kitti.txt", pose + "\n" + lost + "\n" + pose + "\n");
  ASSERT_EQ(read_trajectory(kitti).size(), 2U);
  EXPECT_EQ(read_trajectory(kitti)[1].time, 2.0);
  EXPECT_EQ(read_trajectory(kitti, temp.put("times.txt", "0.1\n0.2\n0.3\n"))[1].time, 0.3);
  const std::string rows = "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n";
  const std::string none = "nan nan nan nan\n";
  const Trajectory log =
      parse_trajectory("t", "4 4 5\n" + rows + "6 6 7\n" + none + none + none + none + "7 7 8\n" + rows);
  ASSERT_EQ(log.size(), 2U);
  EXPECT_EQ(log[1].time, 7.0);
}

TEST(TrajectoryFile, AByteOrderMarkIsPassedOver) {
  EXPECT_EQ(parse_trajectory("t",
                             "\xEF\xBB\xBF"
                             "1 0 0 0 0 0 0 1\n")
                .size(),
            1U);
  EXPECT_EQ(parse_trajectory("t", "\xEF\xBB\xBF# time\n1 0 0 0 0 0 0 1\n").size(), 1U);
}

TEST(TrajectoryFile, UnwritablePlaceLeavesNothing) {
  const TempFolder temp;
  const std::string file = temp.put("file", "");
  EXPECT_THAT(error_of([&] { write_trajectory(file + "/t.txt", {}); }), HasSubstr("cannot be written"));
  EXPECT_THAT(temp.files(), ElementsAre("file"));
}

struct EvoFile {
  const char* name;
  std::size_t poses;  // number of lines without comments
  const char* first_stamp;
};

class EvoTrajectory : public testing::TestWithParam<EvoFile> {};

TEST_P(EvoTrajectory, IsRead) {
  SHARED_DATA_OR_SKIP(path, std::string("evo/") + GetParam().name);
  const bool kitti = std::string(GetParam().name).starts_with("KITTI");
  const Trajectory t = read_trajectory(path, kitti ? test::shared_data() + "/evo/KITTI_00_gt_times.txt" : "");
  EXPECT_EQ(t.size(), GetParam().poses);
  EXPECT_EQ(t.front().time_text, GetParam().first_stamp);
}

INSTANTIATE_TEST_SUITE_P(All, EvoTrajectory,
                         testing::Values(EvoFile{"KITTI_00_ORB.txt", 4541, "0.000000e+00"},
                                         EvoFile{"KITTI_00_gt.txt", 4541, "0.000000e+00"},
                                         EvoFile{"fr2_desk_ORB.txt", 2893, "1311868164.363181"},
                                         EvoFile{"fr2_desk_ORB_kf_mono.txt", 157, "1311868171.131477"},
                                         EvoFile{"fr2_desk_groundtruth.txt", 20957, "1311868163.8697"},
                                         EvoFile{"freiburg1_xyz-ORB_kf_mono.txt", 32, "1305031110.043299"},
                                         EvoFile{"freiburg1_xyz-groundtruth.txt", 3000, "1305031098.6659"},
                                         EvoFile{"freiburg1_xyz-rgbdslam.txt", 788, "1305031102.160407"},
                                         EvoFile{"freiburg1_xyz-rgbdslam_drift.txt", 788, "1305031102.160407"},
                                         EvoFile{"freiburg1_xyz-rgbdslam_drift_short.txt", 40, "1305031102.160407"},
                                         EvoFile{"tum_fr1_rpy_dvo_cpu_estimate.txt", 100, "1305031229.528784"},
                                         EvoFile{"tum_fr1_rpy_groundtruth.txt", 2742, "1305031225.9334"}));

}  // namespace
}  // namespace odosplat
