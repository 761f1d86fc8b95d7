// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "odosplat/io/camera/camera_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"

namespace odosplat::apps_test {
namespace {

using testing::HasSubstr;

class Calibrate : public testing::Test {
 protected:
  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", 60);
    right_ = read_camera_file(sequence_ + "/camera.yaml");
  }
  /// A camera file beside the sequence.
  std::string declared(double focal_factor, double center_px) {
    CameraFile camera = right_;
    camera.camera.fx *= focal_factor;
    camera.camera.fy *= focal_factor;
    camera.camera.cx += center_px;
    const std::string file = scratch_ / "declared.yaml";
    write_camera_file(file, camera);
    return file;
  }
  RunResult calibrate(const std::vector<std::string>& more) {
    std::vector<std::string> words{"calibrate", sequence_, "--out", found_};
    words.insert(words.end(), more.begin(), more.end());
    return run_odosplat(words);
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string found_ = scratch_ / "found.yaml";
  CameraFile right_;
};

TEST_F(Calibrate, FindsTheCameraByDepthImages) {
  const RunResult run = calibrate({"--camera", declared(1.08, 3.0), "--json", scratch_ / "found.json"});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("focal length: the images want"));
  const CameraFile found = read_camera_file(found_);
  EXPECT_NEAR(found.camera.fx, right_.camera.fx, 0.01 * right_.camera.fx) << run.out;
  EXPECT_NEAR(found.camera.fy, right_.camera.fy, 0.01 * right_.camera.fy);
  EXPECT_NEAR(found.camera.cx, right_.camera.cx, 1.2);
  EXPECT_NEAR(found.depth_scale, right_.depth_scale, 0.02 * right_.depth_scale);
  const auto json = nlohmann::json::parse(read_text(scratch_ / "found.json"));
  EXPECT_EQ(json["camera"]["fx"], found.camera.fx);
  EXPECT_LT(json["measured"]["fx_px"]["sigma"], 0.01 * right_.camera.fx);
}

TEST_F(Calibrate, FindsTheCameraInACloud) {
  const std::string cloud = scratch_ / "cloud.ply";
  ASSERT_EQ(run_odosplat({"cloud", sequence_, "--every", "5", "--voxel", "0.03", "--out", cloud}).status, 0);
  const RunResult run = calibrate({"--camera", declared(0.93, 0.0), "--cloud", cloud});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NEAR(read_camera_file(found_).camera.fx, right_.camera.fx, 0.012 * right_.camera.fx) << run.out;
  EXPECT_EQ(read_camera_file(found_).depth_scale, right_.depth_scale);
}

TEST_F(Calibrate, ChangesOnlyWhatIsAskedFor) {
  const RunResult run = calibrate({"--camera", declared(1.05, 0.0), "--what", "focal"});
  ASSERT_EQ(run.status, 0) << run.err;
  const CameraFile found = read_camera_file(found_);
  EXPECT_NEAR(found.camera.fx, right_.camera.fx, 0.01 * right_.camera.fx);
  EXPECT_NEAR(found.camera.cx, right_.camera.cx, 1e-3);
  EXPECT_TRUE(found.distortion.empty());
  EXPECT_NEAR(found.depth_scale, right_.depth_scale, 1e-3);
}

TEST_F(Calibrate, FindsNothingTheSecondTime) {
  ASSERT_EQ(calibrate({"--camera", declared(1.08, 0.0)}).status, 0);
  const std::string first = scratch_ / "first.yaml";
  std::filesystem::copy_file(found_, first);
  const RunResult again = calibrate({"--camera", first});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_THAT(again.out, HasSubstr("the camera is as declared"));
  EXPECT_NEAR(read_camera_file(found_).camera.fx, read_camera_file(first).camera.fx, 0.5);
}

TEST_F(Calibrate, KeepsWhatIsDeclaredBesides) {
  // The same world with its y axis up, as data with a negative fy have it.
  Trajectory truth = read_trajectory(sequence_ + "/groundtruth.txt");
  const Eigen::Matrix4d F = Eigen::Vector4d(1, -1, 1, 1).asDiagonal();
  for (StampedPose& pose : truth) pose.T_world_camera = SE3::from_matrix(F * pose.T_world_camera.matrix() * F);
  write_trajectory(sequence_ + "/groundtruth.txt", truth);
  CameraFile camera = right_;
  camera.fy_sign = -1;
  camera.camera.fx *= 1.06;
  camera.camera.fy *= 1.06;
  camera.vignette = "vignette.png";
  cv::Mat1w even(120, 160, std::uint16_t{65535});
  ASSERT_TRUE(cv::imwrite(scratch_ / "vignette.png", even));
  const std::string file = scratch_ / "declared.yaml";
  write_camera_file(file, camera);
  const std::string folder = scratch_ / "elsewhere";
  found_ = folder + "/found.yaml";
  const RunResult run = calibrate({"--camera", file});
  ASSERT_EQ(run.status, 0) << run.err;
  const CameraFile found = read_camera_file(found_);  // the vignette's file is found from there
  EXPECT_EQ(found.fy_sign, -1);
  EXPECT_EQ(found.fps, 0.0);
  EXPECT_NEAR(found.camera.fx, right_.camera.fx, 0.01 * right_.camera.fx) << run.out;
  EXPECT_THAT(run_odosplat({"check", sequence_, "--camera", file, "--gap", "10"}).out,
              HasSubstr("focal length: the images want 1"));
  EXPECT_EQ(run_odosplat({"check", sequence_, "--camera", found_, "--gap", "10"}).status, 0);
}

TEST_F(Calibrate, RefusesWhatTellsNothing) {
  // One image shown all the time, from one place.
  const std::string first = read_text(sequence_ + "/groundtruth.txt");
  std::string still;
  std::string pose;
  std::istringstream lines(first);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t blank = line.find(' ');
    if (pose.empty()) pose = line.substr(blank);
    still += line.substr(0, blank) + pose + "\n";
  }
  write_text(sequence_ + "/groundtruth.txt", still);
  const RunResult run = calibrate({});
  EXPECT_EQ(run.status, 3);
  EXPECT_THAT(run.err, HasSubstr("the camera is not measured"));
  EXPECT_FALSE(std::filesystem::exists(found_));
  EXPECT_EQ(calibrate({"--what", "color"}).status, 2);
  EXPECT_EQ(calibrate({"--json", found_}).status, 2);
  std::filesystem::remove(sequence_ + "/depth.txt");
  const RunResult without = calibrate({});
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.err, HasSubstr("--map"));
}

TEST_F(Calibrate, RefusesInvertedPoses) {
  Trajectory truth = read_trajectory(sequence_ + "/groundtruth.txt");
  for (StampedPose& pose : truth) pose.T_world_camera = pose.T_world_camera.inverse();
  write_trajectory(sequence_ + "/groundtruth.txt", truth);
  const RunResult run = calibrate({});
  EXPECT_EQ(run.status, 3) << run.out;
  EXPECT_FALSE(std::filesystem::exists(found_));
}

}  // namespace
}  // namespace odosplat::apps_test
