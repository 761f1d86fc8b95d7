// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// In every layout the frames are in the order in which they were taken, and each has its own image, depth and pose.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/sequence/colmap_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using nlohmann::json;
using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

// The order in which a folder (by bytes) or COLMAP lists the images, which is not the order of their numbers.
const std::vector<int> listed{10, 11, 1, 9, 2, 100};
const std::vector<int> taken{1, 2, 9, 10, 11, 100};
const std::string camera_yaml = "width: 16\nheight: 12\nfx: 20\nfy: 21\ncx: 7.5\ncy: 5.5\ndepth_scale: 1000\n";

cv::Mat3b color_of(int k) { return cv::Mat3b(12, 16, cv::Vec3b::all(static_cast<uchar>(2 * k))); }
cv::Mat1w depth_of(int k) { return cv::Mat1w(12, 16, static_cast<std::uint16_t>(1000 + k)); }
std::string rows(int k, const char* end) {
  return "1 0 0 " + std::to_string(k) + end + "0 1 0 2" + end + "0 0 1 3" + end + "0 0 0 1\n";
}

struct Has {
  bool depth = true;
  bool poses = true;
};

void expect_order(const Sequence& s, const std::string& layout, const Has& has, const std::vector<int>& order = taken) {
  EXPECT_EQ(s.layout(), layout);
  ASSERT_EQ(s.size(), order.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_EQ(std::lround(s.color(i)(5, 5)[0] * 255.0F), 2 * order[i]) << i;
    if (i > 0) {
      EXPECT_GT(s.time(i), s.time(i - 1));
    }
    if (has.depth) {
      EXPECT_NEAR(s.depth(i)(5, 5), 1.0 + 0.001 * order[i], 1e-6) << i;
    }
    if (has.poses) {
      ASSERT_TRUE(s.T_world_camera(i)) << i;
      EXPECT_NEAR(s.T_world_camera(i)->translation().x(), order[i], 1e-9) << i;
    }
  }
  if (has.poses) {
    ASSERT_GE(s.truth().size(), order.size());
    for (std::size_t i = 1; i < s.truth().size(); ++i) EXPECT_GT(s.truth()[i].time, s.truth()[i - 1].time);
  }
}

TEST(FrameOrder, Redwood) {
  const TempFolder temp;
  temp.put("camera.yaml", camera_yaml);
  std::string log;
  for (const int k : listed) {
    temp.put_image("room-color/" + std::to_string(k) + ".png", color_of(k));
    temp.put_image("room-depth/" + std::to_string(k) + ".png", depth_of(k));
  }
  for (const int k : taken) log += std::to_string(k) + " 0 0\n" + rows(k, "\n");
  temp.put("room-traj.txt", log);
  expect_order(Sequence::open(temp.path()), "redwood", {});
}

TEST(FrameOrder, SevenScenes) {
  const TempFolder temp;
  temp.put("camera.yaml", camera_yaml);
  for (const int k : listed) {
    const std::string stem = "frame-" + std::to_string(k);
    temp.put_image(stem + ".color.png", color_of(k));
    temp.put_image(stem + ".depth.png", depth_of(k));
    temp.put(stem + ".pose.txt", rows(k, "\n"));
  }
  expect_order(Sequence::open(temp.path()), "sevenscenes", {});
}

TEST(FrameOrder, Replica) {
  const TempFolder temp;
  temp.put("camera.yaml", camera_yaml);
  std::string poses;
  for (int k = 0; k <= 100; ++k) poses += rows(k, " ");
  for (const int k : listed) {
    temp.put_image("results/frame" + std::to_string(k) + ".png", color_of(k));
    temp.put_image("results/depth" + std::to_string(k) + ".png", depth_of(k));
  }
  temp.put("traj.txt", poses);
  expect_order(Sequence::open(temp.path()), "replica", {});
}

TEST(FrameOrder, Colmap) {
  test::ColmapModel model;
  model.cameras = {{1, 1, "PINHOLE", 16, 12, {20, 21, 8, 6}}};
  std::uint32_t id = 1;
  for (const int k : listed) {
    const SE3 T_world_camera(so3_exp({0.1, 0.02 * k, 0.0}), Eigen::Vector3d(k, 2, 3));
    model.images.push_back({id++, T_world_camera.inverse(), 1, "shot" + std::to_string(k) + ".png"});
  }
  for (const bool binary : {false, true}) {
    const TempFolder temp;
    temp.put(binary ? "cameras.bin" : "cameras.txt", binary ? model.cameras_binary() : model.cameras_text());
    temp.put(binary ? "images.bin" : "images.txt", binary ? model.images_binary() : model.images_text());
    for (const int k : listed) temp.put_image("images/shot" + std::to_string(k) + ".png", color_of(k));
    expect_order(Sequence::open(temp.path()), "colmap", {.depth = false});
  }
}

TEST(FrameOrder, ImageFolder) {
  const TempFolder temp;
  temp.put("camera.yaml", camera_yaml);
  for (const int k : listed) temp.put_image("shot" + std::to_string(k) + ".png", color_of(k));
  expect_order(Sequence::open(temp.path()), "images", {.depth = false, .poses = false});
}

// Lists with stamps are in the order of their stamps, or refused.
TEST(FrameOrder, Tum) {
  const TempFolder temp;
  temp.put("camera.yaml", camera_yaml);
  std::string colors;
  std::string depths;
  std::string truth;
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const std::string name = std::to_string(listed[i]) + ".png";
    temp.put_image("rgb/" + name, color_of(listed[i]));
    temp.put_image("depth/" + name, depth_of(listed[i]));
    colors += std::to_string(i) + " rgb/" + name + "\n";
    depths += std::to_string(i) + " depth/" + name + "\n";
    truth += std::to_string(i) + " " + std::to_string(listed[i]) + " 0 0 0 0 0 1\n";
  }
  temp.put("rgb.txt", colors);
  temp.put("depth.txt", depths);
  temp.put("groundtruth.txt", truth);
  expect_order(Sequence::open(temp.path()), "tum", {}, listed);
  temp.put("rgb.txt", "1 rgb/1.png\n0 rgb/10.png\n");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("rgb.txt: line 2: time 0 is not after 1"));
}

TEST(FrameOrder, Icl) {
  const TempFolder temp;
  temp.put("camera.yaml", camera_yaml);
  std::string list;
  std::string truth;
  for (const int k : listed) {
    temp.put_image("rgb/" + std::to_string(k) + ".png", color_of(k));
    temp.put_image("depth/" + std::to_string(k) + ".png", depth_of(k));
  }
  for (const int k : taken) {
    const std::string id = std::to_string(k);
    list += id + " depth/" + id + ".png " + id + " rgb/" + id + ".png\n";
    truth += id + " " + id + " 0 0 0 0 0 1\n";
  }
  temp.put("associations.txt", list);
  temp.put("traj.gt.freiburg", truth);
  expect_order(Sequence::open(temp.path()), "icl", {});
}

json transforms() {
  json file{{"w", 16}, {"h", 12}, {"fl_x", 20.0}, {"fl_y", 21.0}, {"cx", 8.0}, {"cy", 6.0}};
  for (const int k : listed) {
    const std::string name = std::to_string(k) + ".png";
    file["frames"].push_back({{"file_path", "images/" + name},
                              {"depth_file_path", "depth/" + name},
                              {"transform_matrix", {{1, 0, 0, k}, {0, 1, 0, 2}, {0, 0, 1, 3}, {0, 0, 0, 1}}}});
  }
  return file;
}

void put_transforms(const TempFolder& temp, const json& file) {
  temp.put("transforms.json", file.dump());
  for (const int k : listed) {
    temp.put_image("images/" + std::to_string(k) + ".png", color_of(k));
    temp.put_image("depth/" + std::to_string(k) + ".png", depth_of(k));
  }
}

TEST(FrameOrder, Nerfstudio) {
  const TempFolder temp;
  put_transforms(temp, transforms());
  const Sequence s = Sequence::open(temp.path());
  expect_order(s, "nerfstudio", {});
  EXPECT_NEAR(s.time(5), 5.0 / 30.0, 1e-12);
}

TEST(FrameOrder, NerfstudioWithStamps) {
  const TempFolder temp;
  json file = transforms();
  std::vector<int> by_time = taken;
  std::reverse(by_time.begin(), by_time.end());
  for (json& frame : file["frames"]) {
    frame["timestamp"] = 1000.25 - 0.001 * frame["transform_matrix"][0][3].get<double>();
  }
  put_transforms(temp, file);
  const Sequence s = Sequence::open(temp.path());
  expect_order(s, "nerfstudio", {}, by_time);
  EXPECT_NEAR(s.time(0), 1000.15, 1e-9);
  EXPECT_NEAR(s.truth().back().time, 1000.249, 1e-9);

  // A frame without a pose has no entry among the poses.
  json holed = file;
  for (json& frame : holed["frames"]) {
    if (std::abs(frame["timestamp"].get<double>() - 1000.15) < 1e-9) frame.erase("transform_matrix");
  }
  put_transforms(temp, holed);
  const Sequence with_hole = Sequence::open(temp.path());
  EXPECT_EQ(with_hole.size(), s.size());
  ASSERT_EQ(with_hole.truth().size(), s.truth().size() - 1);
  EXPECT_NEAR(with_hole.time(0), 1000.15, 1e-9);
  for (std::size_t i = 0; i < with_hole.truth().size(); ++i) {
    EXPECT_EQ(with_hole.truth()[i].time, s.truth()[i + 1].time);
    EXPECT_EQ(with_hole.truth()[i].T_world_camera.translation(), s.truth()[i + 1].T_world_camera.translation());
  }

  json fault = file;
  fault["frames"][2].erase("timestamp");
  put_transforms(temp, fault);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
              HasSubstr("timestamp: is given for some of the frames only: images/10.png and images/1.png differ"));
  file["frames"][2]["timestamp"] = file["frames"][0]["timestamp"];
  put_transforms(temp, file);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
              HasSubstr("timestamp: is the same for images/10.png and images/1.png"));
}

}  // namespace
}  // namespace odosplat
