// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Clouds and maps in other formats as input: convert, cloud --from, train --voxel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "odosplat/io/cloud/cloud_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class Clouds : public testing::Test {
 protected:
  void must_run(const std::vector<std::string>& words) {
    const RunResult result = run_odosplat(words);
    EXPECT_EQ(result.status, 0) << testing::PrintToString(words) << "\n" << result.err;
    out_ = result.out;
    log_ = result.err;
  }
  void expect_refused(const std::vector<std::string>& words, const std::string& fault) {
    const RunResult result = run_odosplat(words);
    SCOPED_TRACE(testing::PrintToString(words));
    EXPECT_EQ(result.status, 2);
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_THAT(result.err, testing::ContainsRegex(fault));
    EXPECT_FALSE(fs::exists(scratch_ / "never.ply"));
    EXPECT_FALSE(fs::exists(scratch_ / "never.splat"));
  }

  ScratchFolder scratch_;
  std::string never_ = scratch_ / "never.ply";
  std::string out_;
  std::string log_;
};

// Two Gaussians, the larger one first, which is the order in .splat files.
std::string splat_text() {
  std::string bytes;
  for (const float size : {0.5F, 0.25F}) {
    const float values[6] = {1, 2, 3, size, size, size};
    bytes.append(reinterpret_cast<const char*>(values), sizeof(values));
    for (const int b : {255, 0, 51, 204, 128, 128, 0, 128}) bytes += static_cast<char>(b);
  }
  return bytes;
}

TEST_F(Clouds, ConvertMapsThereAndBack) {
  const std::string splat = scratch_ / "m.splat";
  const std::string ply = scratch_ / "m.ply";
  const std::string back = scratch_ / "back.splat";
  write_text(splat, splat_text());
  must_run({"convert", splat, ply});
  EXPECT_THAT(out_, HasSubstr("m.ply: 2 Gaussians"));
  EXPECT_THAT(read_text(ply), HasSubstr("element vertex 2"));
  must_run({"convert", ply, back});
  EXPECT_EQ(read_text(back), splat_text());
  // The .splat file as input of another command.
  must_run({"view", "map", "--map", splat, "--out", scratch_ / "m.png", "--size", "200x150"});
}

TEST_F(Clouds, ConvertCloudsToPly) {
  const std::string xyz = scratch_ / "c.xyz";
  write_text(xyz, "x y z r g b\n1 2 3 255 0 51\n4 5 6 0 0 0\n");
  must_run({"convert", xyz, scratch_ / "c.ply"});
  const PointCloud cloud = read_point_cloud(scratch_ / "c.ply");
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_TRUE(cloud.has_colors());
}

TEST_F(Clouds, ConvertFaults) {
  const std::string xyz = scratch_ / "c.xyz";
  write_text(xyz, "1 2 3\n");
  expect_refused({"convert", xyz, scratch_ / "never.splat"}, "c.xyz: holds no Gaussians");
  expect_refused({"convert", xyz, scratch_ / "never.las"}, "never.las: must end in");
  expect_refused({"convert", scratch_ / "none.ply", never_}, "none.ply: is missing");
  expect_refused({"convert", scratch_ / "none.splat", never_}, "none.splat: is missing");
  write_text(scratch_ / "cut.splat", splat_text().substr(0, 50));
  expect_refused({"convert", scratch_ / "cut.splat", never_}, "cut.splat: has 50 bytes");
  expect_refused({"track", scratch_.path(), "--map", scratch_ / "cut.splat", "--out", scratch_ / "run"}, "");
  write_text(scratch_ / "bad.ply", "ply\nformat ascii 2.0\n");
  expect_refused({"convert", scratch_ / "bad.ply", never_}, "bad.ply: line 2");
}

TEST_F(Clouds, CloudFromFilesIsThinnedOverAllOfThem) {
  write_text(scratch_ / "a.xyz", "0.01 0.01 0\n0.03 0.01 0\n5 5 5\n");
  write_text(scratch_ / "b.csv", "0.02;0.04;0\n7;7;7\n");
  const std::string thin = scratch_ / "thin.ply";
  must_run({"cloud", "--from", scratch_ / "a.xyz", "--from", scratch_ / "b.csv", "--voxel", "0.1", "--out", thin});
  EXPECT_THAT(out_, HasSubstr("thin.ply: 3 points"));
  const PointCloud cloud = read_point_cloud(thin);
  ASSERT_EQ(cloud.size(), 3U);
  EXPECT_LT((cloud.points[0] - Eigen::Vector3f(0.02F, 0.02F, 0.0F)).norm(), 1e-7F);
}

TEST_F(Clouds, CloudFromSurveyCoordinatesNeedsAnOrigin) {
  write_text(scratch_ / "far.xyz", "500000.125 5400000.377 310.5\n");
  const std::string far = scratch_ / "far.xyz";
  expect_refused({"cloud", "--from", far, "--voxel", "0.1", "--out", never_}, "far.xyz: is too far.*--origin");
  expect_refused({"convert", far, never_}, "far.xyz: is too far.*--origin");
  const std::string near = scratch_ / "near.ply";
  must_run({"cloud", "--from", far, "--origin", "500000", "5400000", "-10", "--out", near});
  EXPECT_LT((read_point_cloud(near).points.at(0) - Eigen::Vector3f(0.125F, 0.377F, 320.5F)).norm(), 1e-6F);
  EXPECT_THAT(read_text(near), HasSubstr("comment origin taken off 500000 5400000 -10\n"));
}

TEST_F(Clouds, CloudDropsOutliersIfAsked) {
  std::string text;
  for (int i = 0; i < 400; ++i) text += std::to_string(0.1 * (i % 20)) + " " + std::to_string(0.1 * (i / 20)) + " 0\n";
  write_text(scratch_ / "plane.xyz", text + "1 1 30\n");
  const std::vector<std::string> words{"cloud", "--from", scratch_ / "plane.xyz", "--voxel", "0.01", "--out"};
  const auto points = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> all = words;
    all.push_back(scratch_ / name);
    all.insert(all.end(), more.begin(), more.end());
    must_run(all);
    return read_point_cloud(scratch_ / name).size();
  };
  EXPECT_EQ(points("all.ply", {}), 401U);
  EXPECT_EQ(points("kept.ply", {"--remove-outliers"}), 400U);
  EXPECT_THAT(log_, HasSubstr("1 of 401 points are outliers"));
}

TEST_F(Clouds, CloudFlagsThatDoNotBelongTogether) {
  write_text(scratch_ / "a.xyz", "1 2 3\n");
  const std::string from = scratch_ / "a.xyz";
  expect_refused({"cloud", "--out", never_}, "SEQ: or --from is needed");
  expect_refused({"cloud", scratch_.path(), "--from", from, "--out", never_}, "--from");
  expect_refused({"cloud", "--from", from, "--noise", "0.1", "--out", never_}, "--noise");
  expect_refused({"cloud", "--from", from, "--every", "2", "--out", never_}, "--every");
  expect_refused({"cloud", scratch_.path(), "--origin", "1", "2", "3", "--out", never_}, "--origin");
  expect_refused({"cloud", "--from", from, "--voxel", "0", "--out", never_}, "voxel: must be a number above 0");
}

TEST_F(Clouds, FramesPickFromThoseThatEveryPicks) {
  write_tiny_sequence(scratch_ / "seq", 24);
  const auto cloud = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> words{"cloud", scratch_ / "seq", "--out", scratch_ / name};
    words.insert(words.end(), more.begin(), more.end());
    must_run(words);
    return read_text(scratch_ / name);
  };
  const std::string first = cloud("first.ply", {"--every", "24"});
  EXPECT_EQ(cloud("a.ply", {"--every", "8", "--frames", "0:8"}), first);
  EXPECT_EQ(cloud("b.ply", {"--every", "8", "--frames", ":5"}), first);
  EXPECT_NE(cloud("c.ply", {"--every", "8", "--frames", "1:"}), first);
  EXPECT_NE(cloud("d.ply", {"--every", "8", "--frames", "0:9"}), first);
  for (const char* command : {"cloud", "train"}) {
    std::vector<std::string> words{command, scratch_ / "seq", "--out", never_, "--frames", "1:8"};
    if (command == std::string("train")) words.insert(words.end(), {"--cloud", scratch_ / "first.ply"});
    expect_refused(words, "no frame in question has a pose");
    for (const char* wrong : {"5", "5:5", "7:5", "a:b", "1:2:3", "-1:4", "1.5:4"}) {
      std::vector<std::string> wrong_words = words;
      *std::find(wrong_words.begin(), wrong_words.end(), "1:8") = wrong;
      expect_refused(wrong_words, "--frames: must be A:B");
    }
  }
}

TEST_F(Clouds, TrainThinsItsCloud) {
  write_tiny_sequence(scratch_ / "seq", 24);
  const std::string cloud = scratch_ / "cloud.ply";
  const std::string map = scratch_ / "map.splat";
  must_run({"cloud", scratch_ / "seq", "--every", "8", "--voxel", "0.05", "--out", cloud});
  const std::vector<std::string> words{
      "train", scratch_ / "seq",   "--every", "8", "--cloud", cloud, "--iterations", "2", "--out", map, "--voxel",
      "0.2",   "--remove-outliers"};
  must_run(words);
  EXPECT_THAT(log_, HasSubstr("points thinned to"));
  EXPECT_THAT(log_, HasSubstr("are outliers"));
  EXPECT_LT(fs::file_size(map) / 32, read_point_cloud(cloud).size() / 4);
}

}  // namespace
}  // namespace odosplat::apps_test
