// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Sequences whose images were taken some time after their stamps, as the clock of the poses counts.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>

#include "odosplat/io/sequence/moved_sequence.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::TempFolder;
using testing::HasSubstr;

const std::string pinhole = "width: 16\nheight: 12\nfx: 20\nfy: 20\ncx: 7.5\ncy: 5.5\ndepth_scale: 500\n";
const std::string other_camera =
    "depth_camera:\n  width: 16\n  height: 12\n  fx: 20\n  fy: 20\n  cx: 7.5\n  cy: 5.5\n"
    "  T_color_depth: [0, 0, 0, 0, 0, 0, 1]\n";

std::string pose_line(const std::string& stamp, const std::string& x) { return stamp + " " + x + " 0 0 0 0 0 1\n"; }

void put_pair(const TempFolder& temp, const std::string& color, const std::string& depth) {
  temp.put_image(color, cv::Mat3b(12, 16, cv::Vec3b::all(40)));
  if (!depth.empty()) temp.put_image(depth, cv::Mat1w(12, 16, std::uint16_t{1000}));
}

/// Images at 10.0, 10.1 and 10.2 s with depth images 10 ms later; poses at 10.0, 10.1 and 10.2 s that move by 1 m in
/// 0.1 s along x.
void put_tum_folder(const TempFolder& temp, const std::string& camera) {
  std::string colors;
  std::string depths;
  std::string truth;
  for (int k = 0; k < 3; ++k) {
    const std::string number = std::to_string(k);
    put_pair(temp, "rgb/" + number + ".png", "depth/" + number + ".png");
    colors += "10." + number + "00 rgb/" + number + ".png\n";
    depths += "10." + number + "10 depth/" + number + ".png\n";
    truth += pose_line("10." + number + "00", number);
  }
  temp.put("rgb.txt", colors);
  temp.put("depth.txt", depths);
  temp.put("groundtruth.txt", truth);
  temp.put("camera.yaml", camera);
}

/// A folder of 7-Scenes: frame k at k / fps, with depth if asked for, and the pose (k, 0, 0).
void put_numbered_folder(const TempFolder& temp, const std::string& camera, int frames, bool with_depth) {
  for (int k = 0; k < frames; ++k) {
    const std::string stem = "frame-00000" + std::to_string(k);
    put_pair(temp, stem + ".color.png", with_depth ? stem + ".depth.png" : "");
    temp.put(stem + ".pose.txt", "1 0 0 " + std::to_string(k) + "\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  }
  temp.put("camera.yaml", camera);
}

double x_of_camera(const Sequence& s, std::size_t i) { return s.T_world_camera(i).value().translation().x(); }
double x_of_depth(const Sequence& s, std::size_t i) { return s.T_world_depth(i).value().translation().x(); }

TEST(SequenceTimeOffset, AnImageHasThePoseOfTheTimeAtWhichItWasTaken) {
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n");
  testing::internal::CaptureStderr();
  const Sequence s = Sequence::open(temp.path());
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              HasSubstr("1 of 3 images have no pose at their time, which time_offset of " + temp / "camera.yaml"));
  EXPECT_NEAR(x_of_camera(s, 0), 0.25, 1e-9);
  EXPECT_NEAR(x_of_camera(s, 1), 1.25, 1e-9);
  // After the last pose the camera's place is not known.
  EXPECT_FALSE(s.T_world_camera(2).has_value());
  EXPECT_EQ(s.time(1), 10.1);
  EXPECT_EQ(s.time_text(1), "10.100");
  EXPECT_EQ(s.camera_file().time_offset, 0.025);
}

TEST(SequenceTimeOffset, CountsBothWaysAndWithinTheUsualLimits) {
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: -0.05\n");
  const Sequence before = Sequence::open(temp.path());
  EXPECT_FALSE(before.T_world_camera(0).has_value());
  EXPECT_NEAR(x_of_camera(before, 1), 0.5, 1e-9);
  EXPECT_NEAR(x_of_camera(before, 2), 1.5, 1e-9);
  put_tum_folder(temp, pinhole + "time_offset: 0.2\n");
  const Sequence far = Sequence::open(temp.path());
  EXPECT_EQ(x_of_camera(far, 0), 2.0);
  EXPECT_FALSE(far.T_world_camera(1).has_value());
  put_tum_folder(temp, pinhole + "time_offset: 0.008\n");
  const Sequence near = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_camera(near, 1), 1.08, 1e-9);
  EXPECT_EQ(x_of_camera(near, 2), 2.0);  // the nearest pose, within 10 ms
}

TEST(SequenceTimeOffset, HoldsForDepthImagesOfTheSameCamera) {
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_depth(s, 0), 0.35, 1e-9);
  EXPECT_NEAR(x_of_depth(s, 1), 1.35, 1e-9);
  EXPECT_FALSE(s.T_world_depth(2).has_value());
  std::filesystem::remove(temp / "depth.txt");
  const Sequence without_depth = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_depth(without_depth, 0), 0.25, 1e-9);
}

TEST(SequenceTimeOffset, DoesNotHoldForADepthCamera) {
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n" + other_camera);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_camera(s, 0), 0.25, 1e-9);
  EXPECT_NEAR(x_of_depth(s, 0), 0.1, 1e-9);
  EXPECT_NEAR(x_of_depth(s, 1), 1.1, 1e-9);
  EXPECT_FALSE(s.T_world_depth(2).has_value());  // nor has its image
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n" + other_camera + "  time_offset: 0.05\n");
  const Sequence own = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_camera(own, 0), 0.25, 1e-9);
  EXPECT_NEAR(x_of_depth(own, 0), 0.6, 1e-9);
  put_tum_folder(temp, pinhole + other_camera + "  time_offset: 0.05\n");
  const Sequence depth_alone = Sequence::open(temp.path());
  EXPECT_EQ(x_of_camera(depth_alone, 0), 0.0);
  EXPECT_NEAR(x_of_depth(depth_alone, 0), 0.6, 1e-9);
}

TEST(SequenceTimeOffset, TruthHasThePosesOfTheImagesAtTheirStamps) {
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n");
  const Sequence s = Sequence::open(temp.path());
  ASSERT_EQ(s.truth().size(), 2U);
  EXPECT_EQ(s.truth()[1].stamp(), "10.100");
  EXPECT_EQ(s.truth()[1].time, s.time(1));
  EXPECT_NEAR(s.truth()[1].T_world_camera.translation().x(), 1.25, 1e-9);
  ASSERT_EQ(s.listed_poses().size(), 3U);
  EXPECT_EQ(s.listed_poses()[1].time, 10.1);
  EXPECT_EQ(s.listed_poses()[1].T_world_camera.translation().x(), 1.0);
  temp.put("camera.yaml", pinhole);
  const Sequence without_offset = Sequence::open(temp.path());
  EXPECT_EQ(without_offset.truth().size(), 3U);
  EXPECT_EQ(&without_offset.truth(), &without_offset.listed_poses());
}

TEST(SequenceTimeOffset, GivesNoPoseToAnImageThatHasNone) {
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n");
  const std::string around =
      pose_line("10.000", "0") + pose_line("10.050", "0.5") + pose_line("10.075", "0.75") + pose_line("10.150", "1.5");
  temp.put("groundtruth.txt", around);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_camera(s, 0), 0.25, 1e-9);
  EXPECT_NEAR(x_of_camera(s, 1), 1.25, 1e-9);
  for (const char* stamp : {"10.100", "10.125"}) {
    std::string invalid = around;
    invalid.insert(invalid.find("10.150"), pose_line(stamp, "nan"));
    temp.put("groundtruth.txt", invalid);
    const Sequence with_hole = Sequence::open(temp.path());
    EXPECT_TRUE(with_hole.T_world_camera(0).has_value());
    EXPECT_FALSE(with_hole.T_world_camera(1).has_value()) << stamp;
    EXPECT_FALSE(with_hole.T_world_depth(1).has_value()) << stamp;
  }
}

TEST(SequenceTimeOffset, InterpolatesPosesThatBelongToTheirImages) {
  const TempFolder temp;
  put_numbered_folder(temp, pinhole + "fps: 10\ntime_offset: 0.05\n", 6, true);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "sevenscenes");
  ASSERT_EQ(s.size(), 6U);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(s.time(i), 0.1 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(x_of_camera(s, i), static_cast<double>(i) + 0.5, 1e-9);
    EXPECT_NEAR(x_of_depth(s, i), static_cast<double>(i) + 0.5, 1e-9);
  }
  EXPECT_FALSE(s.T_world_camera(5).has_value());
  EXPECT_EQ(s.truth().size(), 5U);
  EXPECT_EQ(s.listed_poses().size(), 6U);
  // The depth camera has its own offset, which is none.
  temp.put("camera.yaml", pinhole + "fps: 10\ntime_offset: 0.05\n" + other_camera);
  const Sequence two_cameras = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_camera(two_cameras, 2), 2.5, 1e-9);
  EXPECT_NEAR(x_of_depth(two_cameras, 2), 2.0, 1e-9);
}

TEST(SequenceTimeOffset, ANumberWithoutPoseStaysWithout) {
  const TempFolder temp;
  put_numbered_folder(temp, pinhole + "fps: 30\ntime_offset: 0.01\n", 4, false);
  std::filesystem::remove(temp / "frame-000002.pose.txt");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_NEAR(x_of_camera(s, 0), 0.3, 1e-9);
  EXPECT_NEAR(x_of_camera(s, 1), 1.3, 1e-9);  // between the poses of images 1 and 3
  EXPECT_FALSE(s.T_world_camera(2).has_value());
}

TEST(SequenceTimeOffset, GoesByTheStampsOfNerfstudio) {
  const TempFolder temp;
  std::string frames;
  for (int k = 0; k < 3; ++k) {
    const std::string number = std::to_string(k);
    put_pair(temp, number + ".png", "");
    frames += std::string(k > 0 ? "," : "") + R"({"file_path": ")" + number + R"(.png", "timestamp": )" +
              std::to_string(5.0 + 0.05 * k) + R"(, "transform_matrix": [[1,0,0,)" + number +
              R"(],[0,1,0,0],[0,0,1,0],[0,0,0,1]]})";
  }
  temp.put("transforms.json", R"({"frames": [)" + frames + "]}");
  temp.put("camera.yaml", pinhole + "time_offset: 0.025\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "nerfstudio");
  EXPECT_NEAR(s.time(1), 5.05, 1e-12);
  EXPECT_NEAR(x_of_camera(s, 0), 0.5, 1e-9);
  EXPECT_NEAR(x_of_camera(s, 1), 1.5, 1e-9);
  EXPECT_FALSE(s.T_world_camera(2).has_value());
}

TEST(SequenceTimeOffset, AMovedSequenceKeepsIt) {
  const Similarity moved{2.0, SE3(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0})};
  const TempFolder temp;
  put_tum_folder(temp, pinhole + "time_offset: 0.025\n");
  const Sequence from = Sequence::open(temp.path());
  EXPECT_EQ(write_moved_sequence(temp / "moved", from, moved), 2U);
  const Sequence to = Sequence::open(temp / "moved");
  EXPECT_EQ(to.camera_file().time_offset, 0.025);
  EXPECT_EQ(to.listed_poses().size(), 3U);
  ASSERT_EQ(to.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(x_of_camera(to, i), 1.0 + 2.0 * x_of_camera(from, i), 1e-6);
    EXPECT_NEAR(x_of_depth(to, i), 1.0 + 2.0 * x_of_depth(from, i), 1e-6);
  }
  const TempFolder numbered;
  put_numbered_folder(numbered, pinhole + "fps: 10\ntime_offset: 0.05\n", 4, false);
  EXPECT_EQ(write_moved_sequence(numbered / "moved", Sequence::open(numbered.path()), moved), 3U);
  EXPECT_NEAR(x_of_camera(Sequence::open(numbered / "moved"), 1), 1.0 + 2.0 * 1.5, 1e-6);
}

}  // namespace
}  // namespace odosplat
