// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Sequences whose depth images are of another camera than the colour images.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/io/sequence/moved_sequence.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;

const std::string color_lines = "width: 32\nheight: 24\nfx: 30\nfy: 30\ncx: 15.5\ncy: 11.5\ndepth_scale: 1000\n";
const std::string depth_lines =
    "depth_camera:\n  width: 24\n  height: 18\n  fx: 18\n  fy: 18\n  cx: 11.5\n  cy: 8.5\n"
    "  T_color_depth: [-0.1, 0, 0.2, 0, 0, 0, 1]\n";

/// Colour images of 32x24; depth images of 24x18 that show a wall at 2 m; poses that move by 1 m in 0.1 s along x.
void put_frames(const TempFolder& temp, const std::string& camera) {
  temp.put("camera.yaml", camera);
  std::string colors;
  std::string depths;
  std::string truth;
  for (int k = 0; k < 3; ++k) {
    const std::string stamp = "10." + std::to_string(k) + "00";
    temp.put_image("rgb/" + stamp + ".png", cv::Mat3b(24, 32, cv::Vec3b(90, 90, 90)));
    temp.put_image("depth/" + stamp + ".png", cv::Mat1w(18, 24, std::uint16_t{2000}));
    colors += stamp + " rgb/" + stamp + ".png\n";
    depths += stamp + " depth/" + stamp + ".png\n";
    truth += stamp + " " + std::to_string(k) + " 0 0 0 0 0 1\n";
  }
  temp.put("rgb.txt", colors);
  temp.put("depth.txt", depths);
  temp.put("groundtruth.txt", truth);
}

TEST(SequenceDepthCamera, DepthIsThatOfTheColourCamera) {
  const TempFolder temp;
  put_frames(temp, color_lines + depth_lines);
  const Sequence s = Sequence::open(temp.path());
  const DepthImage depth = s.depth(1);
  ASSERT_EQ(depth.size(), cv::Size(32, 24));
  EXPECT_NEAR(depth(12, 16), 2.2F, 1e-5F);  // the depth camera is 20 cm ahead
  EXPECT_EQ(s.T_world_depth(1)->translation().x(), 1.0);
  EXPECT_TRUE(s.camera_file().depth_camera.has_value());
}

TEST(SequenceDepthCamera, DepthOfAnotherSizeNeedsIt) {
  const TempFolder temp;
  put_frames(temp, color_lines);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()).depth(0); }),
              testing::HasSubstr("is 24x18, its colour image"));
  std::string wrong = depth_lines;
  wrong.replace(wrong.find("width: 24"), 9, "width: 26");
  put_frames(temp, color_lines + wrong);
  EXPECT_EQ(error_of([&] { Sequence::open(temp.path()).depth(0); }),
            temp / "depth/10.000.png" + ": is 24x18, the depth_camera of " + temp / "camera.yaml" + " is for 26x18");
}

TEST(SequenceDepthCamera, ATimeOffsetMovesThePoseOfDepth) {
  const TempFolder temp;
  put_frames(temp, color_lines + depth_lines + "  time_offset: 0.025\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.T_world_camera(0)->translation().x(), 0.0);
  EXPECT_NEAR(s.T_world_depth(0)->translation().x(), 0.25, 1e-9);
  EXPECT_NEAR(s.T_world_depth(1)->translation().x(), 1.25, 1e-9);
  // After the last pose the camera's place is not known.
  EXPECT_TRUE(s.T_world_camera(2).has_value());
  EXPECT_FALSE(s.T_world_depth(2).has_value());
}

TEST(SequenceDepthCamera, ATimeOffsetGivesNoPoseToAnImageThatHasNone) {
  const TempFolder temp;
  put_frames(temp, color_lines + depth_lines + "  time_offset: 0.025\n");
  temp.put("groundtruth.txt",
           "10.000 0 0 0 0 0 0 1\n10.050 0 0 0 0 0 0 1\n10.100 nan 0 0 0 0 0 1\n10.150 1 0 0 0 0 0 1\n");
  // The stamp of depth has a pose of its own, which is not that of the time at which it was taken.
  temp.put("depth.txt", "10.105 depth/10.100.png\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.T_world_camera(1).has_value());
  EXPECT_FALSE(s.T_world_depth(1).has_value());
}

TEST(SequenceDepthCamera, HasNoDepthWhereTheUndistortedImageShowsNothing) {
  const TempFolder temp;
  put_frames(temp, color_lines + "distortion: [0.4, 0, 0, 0]\n" + depth_lines);
  const Sequence s = Sequence::open(temp.path());
  const ColorImage color = s.color(1);
  const DepthImage depth = s.depth(1);
  int unseen = 0;
  for (int y = 0; y < depth.rows; ++y) {
    for (int x = 0; x < depth.cols; ++x) {
      if (color(y, x) != cv::Vec3f(0.0F, 0.0F, 0.0F)) continue;
      ++unseen;
      EXPECT_EQ(depth(y, x), 0.0F) << x << " " << y;
    }
  }
  EXPECT_GT(unseen, 10);
  EXPECT_GT(cv::countNonZero(depth), 200);
}

TEST(SequenceDepthCamera, AMovedSequenceKeepsIt) {
  const TempFolder temp;
  put_frames(temp, color_lines + depth_lines);
  const Sequence from = Sequence::open(temp.path());
  const Similarity moved{2.0, SE3(Eigen::Quaterniond::Identity(), {1.0, 0.0, 0.0})};
  write_moved_sequence(temp / "moved", from, moved);
  const Sequence to = Sequence::open(temp / "moved");
  EXPECT_NEAR(to.depth(1)(12, 16), 2.0 * from.depth(1)(12, 16), 1e-5);
  EXPECT_NEAR(to.camera_file().depth_camera->T_color_depth.translation().z(), 0.4, 1e-12);
}

}  // namespace
}  // namespace odosplat
