// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Public sequences, if they are available: facts from their descriptions, and the geometry by reprojection.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;
using test::TempFolder;

// Median |difference| [mm] between depth of frame i transformed to frame j by the poses, and the depth measured there.
double reprojection_mm(const Sequence& s, std::size_t i, std::size_t j) {
  const DepthImage from = s.depth(i);
  const DepthImage to = s.depth(j);
  const SE3 T_j_i = s.T_world_depth(j)->inverse() * *s.T_world_depth(i);
  std::vector<double> errors;
  for (int y = 0; y < from.rows; y += 2) {
    for (int x = 0; x < from.cols; x += 2) {
      if (from(y, x) == 0.0F) continue;
      const Eigen::Vector3d p = T_j_i * Eigen::Vector3d(from(y, x) * s.camera().ray(x, y));
      if (p.z() <= 0.0) continue;
      const Eigen::Vector2d pixel = s.camera().project(p);
      const auto u = static_cast<int>(std::lround(pixel.x()));
      const auto v = static_cast<int>(std::lround(pixel.y()));
      if (u < 0 || v < 0 || u >= to.cols || v >= to.rows || to(v, u) == 0.0F) continue;
      errors.push_back(1000.0 * std::abs(static_cast<double>(to(v, u)) - p.z()));
    }
  }
  if (errors.size() < 1000) return 1e9;
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2), errors.end());
  return errors[errors.size() / 2];
}

struct Facts {
  const char* path;
  const char* layout;
  std::size_t frames;
  std::size_t truth;
  Camera camera;
  int fy_sign;
  double depth_scale;
  std::size_t i;
  std::size_t j;
  double max_error_mm;  // of depth reprojected from i to j; usual values are in the sets' description
};

void PrintTo(const Facts& facts, std::ostream* out) { *out << facts.path; }

class SharedSequence : public testing::TestWithParam<Facts> {};

TEST_P(SharedSequence, IsReadAsDescribed) {
  const Facts& facts = GetParam();
  SHARED_DATA_OR_SKIP(path, facts.path);
  const Sequence s = Sequence::open(path);
  EXPECT_EQ(s.layout(), facts.layout);
  EXPECT_EQ(s.size(), facts.frames);
  EXPECT_EQ(s.truth().size(), facts.truth);
  EXPECT_EQ(s.camera(), facts.camera);
  EXPECT_EQ(s.fy_sign(), facts.fy_sign);
  EXPECT_EQ(s.depth_scale(), facts.depth_scale);
  EXPECT_NEAR(s.fps(), 30.0, 3.0);
  for (const std::size_t k : {std::size_t{0}, s.size() - 1}) {
    EXPECT_EQ(s.color(k).size(), cv::Size(facts.camera.width, facts.camera.height));
    EXPECT_TRUE(s.has_depth(k));
  }
  EXPECT_LT(reprojection_mm(s, facts.i, facts.j), facts.max_error_mm);
}

INSTANTIATE_TEST_SUITE_P(
    All, SharedSequence,
    testing::Values(
        Facts{"icl_office_kt3", "tum", 1100, 1100, {320, 240, 240.6, 240, 159.5, 119.5}, 1, 1000, 300, 320, 4.0},
        Facts{"icl_office_traj3_frei_png", "icl", 16, 1100, {640, 480, 481.2, 480, 319.5, 239.5}, -1, 5000, 1, 15, 2.0},
        Facts{"aug_icl_livingroom1", "tum", 211, 211, {640, 480, 525, 525, 319.5, 239.5}, 1, 1000, 100, 120, 1.5},
        Facts{
            "aug_icl_livingroom1_redwood", "redwood", 30, 30, {640, 480, 525, 525, 319.5, 239.5}, 1, 1000, 0, 20, 1.5},
        Facts{"7scenes_redkitchen", "tum", 160, 240, {320, 240, 292.5, 292.5, 159.75, 119.75}, 1, 1000, 40, 50, 12.0},
        Facts{
            "7scenes_redkitchen_official", "sevenscenes", 12, 12, {640, 480, 525, 525, 320, 240}, 1, 1000, 0, 10, 12.0},
        Facts{"tum_fr1_rpy_short",
              "tum",
              8,
              2742,
              {640, 480, 517.306408, 516.469215, 318.643040, 255.313989},
              1,
              5000,
              2,
              3,
              12.0},
        Facts{"replica_office0_short", "replica", 4, 2000, {1200, 680, 600, 600, 599.5, 339.5}, 1, 6553.5, 0, 3, 1.5}));

TEST(SharedIcl, ReflectedPosesAreThoseOfTheReducedSet) {
  SHARED_DATA_OR_SKIP(archive, "icl_office_traj3_frei_png");
  SHARED_DATA_OR_SKIP(reduced, "icl_office_kt3");
  const Sequence a = Sequence::open(archive);
  const Sequence b = Sequence::open(reduced);
  EXPECT_FALSE(a.T_world_camera(0));
  for (std::size_t k = 1; k < 16; ++k) {
    ASSERT_TRUE(a.T_world_camera(k));
    const SE3 difference = a.T_world_camera(k)->inverse() * *b.T_world_camera(k - 1);
    EXPECT_LT(difference.log().norm(), 1e-5) << k;
    EXPECT_EQ(a.time_text(k), b.time_text(k - 1));
  }
  EXPECT_EQ(a.T_world_camera(1)->translation(), Eigen::Vector3d(0, 0, -2.5));
}

// A camera file with a negative fy, although the poses belong to a positive one.
TEST(SharedKt3, AWrongSignOfFyShowsInReprojectionUnlessPosesAreTakenAsStored) {
  SHARED_DATA_OR_SKIP(path, "icl_office_kt3");
  const TempFolder temp;
  SequenceOptions options;
  options.camera_file =
      temp.put("c.yaml", "width: 320\nheight: 240\nfx: 240.6\nfy: -240\ncx: 159.5\ncy: 119.5\ndepth_scale: 1000\n");
  const Sequence wrong = Sequence::open(path, options);
  EXPECT_EQ(wrong.fy_sign(), -1);
  EXPECT_GT(reprojection_mm(wrong, 300, 320), 10.0);
  options.as_stored = true;
  const Sequence stored = Sequence::open(path, options);
  EXPECT_EQ(stored.fy_sign(), -1);
  EXPECT_LT(reprojection_mm(stored, 300, 320), 4.0);
}

TEST(SharedRedwood, AgreesWithTheTumCopy) {
  SHARED_DATA_OR_SKIP(redwood, "aug_icl_livingroom1_redwood");
  SHARED_DATA_OR_SKIP(tum, "aug_icl_livingroom1");
  const Sequence a = Sequence::open(redwood);
  const Sequence b = Sequence::open(tum);
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_LT((a.T_world_camera(k)->inverse() * *b.T_world_camera(k)).log().norm(), 1e-6) << k;
  }
  EXPECT_EQ(cv::norm(a.color(17), b.color(17), cv::NORM_INF), 0.0);
  EXPECT_EQ(cv::norm(a.depth(17), b.depth(17), cv::NORM_INF), 0.0);
}

TEST(SharedSevenScenes, AgreesWithTheReducedCopy) {
  SHARED_DATA_OR_SKIP(official, "7scenes_redkitchen_official/seq-01");
  SHARED_DATA_OR_SKIP(reduced, "7scenes_redkitchen");
  const Sequence a = Sequence::open(official);
  const Sequence b = Sequence::open(reduced);
  const SE3 T_color_depth = a.camera_file().depth_camera->T_color_depth;
  for (std::size_t k = 0; k < a.size(); ++k) {
    // The copy has the poses as published, which are the depth camera's.
    const SE3 T_world_depth = *a.T_world_camera(k) * T_color_depth;
    EXPECT_LT((T_world_depth.inverse() * *b.T_world_camera(k)).log().norm(), 1e-5) << k;
    const DepthImage depth = a.depth(k);
    EXPECT_LT(*std::max_element(depth.begin(), depth.end()), 20.0F);  // 65535 means no depth
  }
}

// The copy was registered by another program, at full size.
TEST(SharedSevenScenes, DepthIsRegisteredAsInTheRegisteredCopy) {
  SHARED_DATA_OR_SKIP(published, "7scenes_redkitchen");
  SHARED_DATA_OR_SKIP(registered, "7scenes_redkitchen_registered");
  const TempFolder temp;
  SequenceOptions options;
  options.camera_file = temp.put(
      "c.yaml",
      "width: 320\nheight: 240\nfx: 262.7525\nfy: 262.7525\ncx: 159.5\ncy: 119.5\ndepth_scale: 1000\n"
      "depth_camera:\n  width: 320\n  height: 240\n  fx: 292.5\n  fy: 292.5\n  cx: 159.75\n  cy: 119.75\n"
      "  T_color_depth: [-0.025558943, 0.000101096, 0.002031832, 0.0040806, -0.0039465, -0.0013544, 0.9999829]\n");
  const Sequence a = Sequence::open(published, options);
  const Sequence b = Sequence::open(registered);
  for (const std::size_t k : {std::size_t{0}, std::size_t{80}, std::size_t{159}}) {
    const DepthImage ours = a.depth(k);
    const DepthImage theirs = b.depth(k);
    ASSERT_EQ(ours.size(), theirs.size());
    std::vector<float> differences;
    for (int y = 0; y < ours.rows; ++y) {
      for (int x = 0; x < ours.cols; ++x) {
        if (ours(y, x) > 0.0F && theirs(y, x) > 0.0F) differences.push_back(std::abs(ours(y, x) - theirs(y, x)));
      }
    }
    ASSERT_GT(differences.size(), static_cast<std::size_t>(cv::countNonZero(theirs)) * 8 / 10);
    EXPECT_LT(upper_median(differences), 0.004F) << k;
  }
}

TEST(SharedTum, DepthIsTheNearestInTimeAndDistortionIsGone) {
  SHARED_DATA_OR_SKIP(path, "tum_fr1_rpy_short");
  const Sequence s = Sequence::open(path);
  EXPECT_EQ(s.time_text(0), "1305031249.529692");
  for (std::size_t i = 0; i < s.size(); ++i) {
    ASSERT_TRUE(s.has_depth(i)) << i;
    ASSERT_TRUE(s.T_world_camera(i)) << i;
    // Motion capture every 10 ms during a fast turn: less than 3 degrees between two poses.
    double nearest = 1e9;
    for (const StampedPose& pose : s.truth()) {
      if (std::abs(pose.time - s.time(i)) > 0.01) continue;
      nearest = std::min(nearest, (pose.T_world_camera.inverse() * *s.T_world_camera(i)).log().norm());
    }
    EXPECT_LT(nearest, 0.05) << i;
  }
  EXPECT_EQ(s.truth().front().time_text, "1305031225.9334");
  // Reads the sequence again without its lens distortion: the images differ.
  TempFolder temp;
  fs::copy(path, temp / "raw", fs::copy_options::recursive);
  std::ifstream in(path + "/camera.yaml");
  std::string yaml;
  for (std::string line; std::getline(in, line);) yaml += line.starts_with("distortion") ? "" : line + "\n";
  temp.put("raw/camera.yaml", yaml);
  const Sequence raw = Sequence::open(temp / "raw");
  EXPECT_GT(cv::norm(raw.color(0), s.color(0), cv::NORM_L1), 1000.0);
}

TEST(SharedKt3, FirstPoseAloneAndNoDepthFolder) {
  const TempFolder temp;
  SHARED_DATA_OR_SKIP(path, "icl_office_kt3");
  fs::create_directories(temp / "kt3");
  for (const char* name : {"rgb.txt", "depth.txt", "camera.yaml"}) fs::copy(path + "/" + name, temp / "kt3");
  fs::create_directory_symlink(fs::canonical(path + "/rgb"), temp / "kt3/rgb");
  temp.put("kt3/groundtruth.txt", "0.033333 0 0 -2.5 0 0 0 1\n");
  const Sequence s = Sequence::open(temp / "kt3");
  EXPECT_EQ(s.size(), 1100U);
  EXPECT_EQ(s.truth().size(), 1U);
  EXPECT_EQ(s.T_world_camera(0)->translation(), Eigen::Vector3d(0, 0, -2.5));
  EXPECT_FALSE(s.T_world_camera(1));
  EXPECT_FALSE(s.has_depth(0));
}

}  // namespace
}  // namespace odosplat
