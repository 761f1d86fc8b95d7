// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Sequences as written by other programs and operating systems.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

const std::string camera_yaml = "width: 16\nheight: 12\nfx: 20\nfy: 20\ncx: 7.5\ncy: 5.5\ndepth_scale: 500\n";
const std::string mark = "\xEF\xBB\xBF";

void put_frame(const TempFolder& temp, const std::string& color, const std::string& depth, int w = 16, int h = 12) {
  temp.put_image(color, cv::Mat3b(h, w, cv::Vec3b::all(40)));
  if (!depth.empty()) temp.put_image(depth, cv::Mat1w(h, w, std::uint16_t{1000}));
}

std::string matrix(int k) { return "1 0 0 " + std::to_string(k) + "\n0 1 0 2\n0 0 1 3\n0 0 0 1\n"; }

TEST(SequenceTum, ReadsAssociationsWithTimes) {
  const TempFolder temp;
  std::string pairs;
  std::string truth;
  for (int k = 0; k < 3; ++k) {
    const std::string stamp = "10." + std::to_string(k);
    put_frame(temp, "rgb/" + stamp + ".png", "depth/" + stamp + ".png");
    pairs += stamp + "00 rgb/" + stamp + ".png " + stamp + "01 depth/" + stamp + ".png\n";
    truth += stamp + " " + std::to_string(k) + " 2 3 0 0 0 1\n";
  }
  temp.put("associations.txt", pairs);
  temp.put("groundtruth.txt", truth);
  temp.put("camera.yaml", camera_yaml);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "tum");
  ASSERT_EQ(s.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.T_world_camera(i)->translation().x(), static_cast<double>(i), 1e-9);
    EXPECT_NEAR(s.depth(i)(0, 0), 2.0F, 1e-6F);
  }
  EXPECT_EQ(s.time_text(1), "10.100");
  EXPECT_EQ(s.depth_time_text(1), "10.101");
  // The motion is 1 m in 0.1 s; depth is 1 ms later.
  EXPECT_NEAR(s.T_world_depth(1)->translation().x(), 1.01, 1e-6);
}

TEST(SequenceTum, AStampWithoutPoseIsNotInterpolatedOver) {
  const TempFolder temp;
  std::string list;
  for (int k = 0; k < 3; ++k) {
    const std::string name = std::to_string(k) + ".png";
    put_frame(temp, name, "");
    list += "10.0" + std::to_string(3 * k) + " " + name + "\n";
  }
  temp.put("rgb.txt", list);
  temp.put("camera.yaml", camera_yaml);
  temp.put("groundtruth.txt", "10.00 0 0 0 0 0 0 1\n10.03 nan nan nan nan nan nan nan\n10.06 1 0 0 0 0 0 1\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_TRUE(s.T_world_camera(0));
  EXPECT_FALSE(s.T_world_camera(1));
  EXPECT_TRUE(s.T_world_camera(2));
  EXPECT_EQ(s.truth().size(), 2U);
}

TEST(SequenceTum, ReadsListsOfWindows) {
  const TempFolder temp;
  put_frame(temp, "rgb/a  b.png", "depth/1.png");
  temp.put("rgb.txt", mark + "10.0 rgb\\a  b.png\r\n");
  temp.put("depth.txt", mark + "10.0 depth\\1.png\r\n");
  temp.put("groundtruth.txt", mark + "10.0 1 2 3 0 0 0 1\r\n");
  temp.put("camera.yaml", mark + camera_yaml);
  const Sequence s = Sequence::open(temp.path());
  ASSERT_EQ(s.size(), 1U);
  EXPECT_TRUE(s.has_depth(0));
  EXPECT_EQ(s.T_world_camera(0)->translation(), Eigen::Vector3d(1, 2, 3));
}

TEST(SequenceSevenScenes, FramesMayLackAPose) {
  const TempFolder temp;
  const std::string lost = "-inf -inf -inf -inf\n";
  for (int k = 0; k < 4; ++k) {
    const std::string stem = "frame-00000" + std::to_string(k);
    put_frame(temp, stem + ".color.png", "");
    if (k != 2) temp.put(stem + ".pose.txt", k == 1 ? lost + lost + lost + lost : matrix(k));
  }
  temp.put("camera.yaml", camera_yaml);
  testing::internal::CaptureStderr();
  const Sequence s = Sequence::open(temp.path());
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr(": 2 of 4 frames have no pose, or one that is not finite"));
  ASSERT_EQ(s.size(), 4U);
  EXPECT_TRUE(s.T_world_camera(0));
  EXPECT_FALSE(s.T_world_camera(1));
  EXPECT_FALSE(s.T_world_camera(2));
  EXPECT_EQ(s.T_world_camera(3)->translation(), Eigen::Vector3d(3, 2, 3));
  EXPECT_EQ(s.truth().size(), 2U);
}

TEST(SequenceRedwood, FramesMayLackAPose) {
  const TempFolder temp;
  std::string log;
  for (int k = 0; k < 3; ++k) {
    put_frame(temp, "room-color/" + std::to_string(k) + ".jpg", "");
    const std::string id = std::to_string(k);
    const std::string none = "nan nan nan nan\n";
    log += id + " " + id + " " + id + "\n" + (k == 1 ? none + none + none + none : matrix(k));
  }
  temp.put("room-traj.txt", mark + log);
  temp.put("camera.yaml", camera_yaml);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.T_world_camera(1));
  EXPECT_EQ(s.T_world_camera(2)->translation(), Eigen::Vector3d(2, 2, 3));
}

TEST(SequenceReplica, FramesMayLackAPose) {
  const TempFolder temp;
  std::string poses;
  for (int k = 0; k < 3; ++k) {
    put_frame(temp, "results/frame" + std::to_string(k) + ".jpg", "");
    for (int i = 0; i < 16; ++i)
      poses += k == 1 ? "-inf " : i % 5 == 0 ? "1 " : i == 3 ? std::to_string(k) + " " : "0 ";
    poses += "\n";
  }
  temp.put("traj.txt", mark + poses);
  temp.put("camera.yaml", camera_yaml);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.T_world_camera(1));
  EXPECT_EQ(s.T_world_camera(2)->translation(), Eigen::Vector3d(2, 0, 0));
}

// macOS creates such files beside every file on drives of other systems and in archives.
TEST(SequenceOpen, FilesThatBeginWithADotAreNone) {
  const TempFolder temp;
  const std::string rubbish("\0\5\x16\7", 4);
  for (const char* name : {"images/._1.png", "images/.hidden.jpg", "scene/._frame-000000.color.png",
                           "scene/._frame-000000.pose.txt", "redwood/._room-color/0.png", "redwood/room-color/._0.jpg",
                           "replica/results/._frame0.jpg", "icl/._traj0.gt.freiburg"}) {
    temp.put(name, rubbish);
  }
  put_frame(temp, "images/1.png", "");
  put_frame(temp, "scene/frame-000000.color.png", "");
  put_frame(temp, "redwood/room-color/0.jpg", "");
  put_frame(temp, "replica/results/frame0.jpg", "");
  put_frame(temp, "icl/rgb/0.png", "icl/depth/0.png");
  temp.put("icl/associations.txt", "0 depth/0.png 0 rgb/0.png\n");
  temp.put("icl/traj0.gt.freiburg", "0 0 0 0 0 0 0 1\n");
  SequenceOptions options;
  options.camera_file = temp.put("camera.yaml", camera_yaml);
  for (const char* folder : {"images", "scene", "redwood", "replica", "icl"}) {
    SCOPED_TRACE(folder);
    EXPECT_EQ(Sequence::open(temp / folder, options).size(), 1U);
  }
}

TEST(SequenceOpen, ImagesOfOnePixelAreRefused) {
  const TempFolder temp;
  put_frame(temp, "images/1.png", "", 1, 12);
  SequenceOptions options;
  options.camera_file = temp.put("camera.yaml", "width: 1\nheight: 12\nfx: 20\nfy: 20\ncx: 0\ncy: 5.5\n");
  EXPECT_THAT(error_of([&] { Sequence::open(temp / "images", options); }),
              HasSubstr("images of 1x12 are too small, must have 2 pixels each way at least"));
}

}  // namespace
}  // namespace odosplat
