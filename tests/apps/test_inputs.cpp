// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Different ways to read the same images: in real time, from a folder, from a video, and by the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <sstream>

#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/apps/tiny_world.hpp"
#include "tests/locations.hpp"

namespace odosplat::apps_test {
namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<double> numbers_of(std::string line) {
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream in(line);
  std::vector<double> numbers;
  for (double value; in >> value;) numbers.push_back(value);
  return numbers;
}

class Inputs : public testing::Test {
 protected:
  static constexpr int frames = 40;

  void SetUp() override {
    write_tiny_sequence(scratch_ / "seq", frames);
    truth_ = read_trajectory(sequence_ + "/groundtruth.txt");
    must_run({"cloud", sequence_, "--every", "5", "--voxel", "0.03", "--noise", "0.002", "--out", cloud_});
    const std::vector<std::string> start = start_words();
    for (const std::string& word : start) start_ += (start_.empty() ? "" : " ") + word;
  }
  static RunResult must_run(const std::vector<std::string>& words) {
    RunResult result = run_odosplat(words);
    EXPECT_EQ(result.status, 0) << testing::PrintToString(words) << "\n" << result.err;
    return result;
  }
  /// The first true pose: tx ty tz qx qy qz qw.
  std::vector<std::string> start_words() const {
    const Eigen::Vector3d& t = truth_[0].T_world_camera.translation();
    const Eigen::Quaterniond& q = truth_[0].T_world_camera.rotation();
    std::vector<std::string> words;
    for (const double value : {t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()}) words.push_back(std::to_string(value));
    return words;
  }
  double largest_error(const Trajectory& trajectory) const {
    double largest = 0.0;
    for (std::size_t k = 0; k < trajectory.size(); ++k) {
      largest = std::max(largest,
                         (trajectory[k].T_world_camera.translation() - truth_[k].T_world_camera.translation()).norm());
    }
    return largest;
  }
  std::string rgb(int k) const {
    char name[32];
    std::snprintf(name, sizeof(name), "/rgb/%04d.png", k);
    return sequence_ + name;
  }

  ScratchFolder scratch_;
  std::string sequence_ = scratch_ / "seq";
  std::string cloud_ = scratch_ / "cloud.ply";
  std::string start_;
  Trajectory truth_;
};

TEST_F(Inputs, InRealTimeEveryFrameIsTrackedOrCountedAsDropped) {
  for (const std::string method : {"interpolation", "rgbd"}) {
    const std::string out = scratch_ / method;
    const RunResult run =
        must_run({"track", sequence_, "--method", method, "--cloud", cloud_, "--out", out, "--realtime"});
    EXPECT_NE(run.out.find("frames dropped"), std::string::npos) << run.out;
    const auto report = nlohmann::json::parse(read_text(out + "/report.json"));
    const int tracked = report["frames"];
    EXPECT_GE(tracked, 1);
    EXPECT_EQ(tracked + report["realtime"]["dropped"].get<int>(), frames);
    const auto status = lines_of(read_text(out + "/status.csv"));
    ASSERT_EQ(status.size(), static_cast<std::size_t>(tracked) + 1);
    int keyframes = 0;
    for (const std::string& line : status) keyframes += line.find(",ok,1,") != std::string::npos ? 1 : 0;
    EXPECT_EQ(keyframes, report["keyframes"].get<int>());
    EXPECT_EQ(read_trajectory(out + "/trajectory.txt").size(), report["posed"].get<std::size_t>());
  }
}

TEST_F(Inputs, EveryPosedFrameHasACovariance) {
  const std::string out = scratch_ / "run";
  // The depth is used as a measurement: if it is only an initial value, as this method does by default, the scale is
  // unobservable.
  must_run({"track", sequence_, "--method", "interpolation", "--cloud", cloud_, "--out", out, "--depth-use",
            "pose_aware_prior"});
  const auto lines = lines_of(read_text(out + "/covariance.csv"));
  const Trajectory live = read_trajectory(out + "/trajectory_live.txt");
  ASSERT_EQ(lines.size(), live.size() + 2);
  EXPECT_EQ(lines[0][0], '#');
  EXPECT_EQ(lines[1].substr(0, 17), "time,tx_tx,tx_ty,");
  for (std::size_t k = 0; k < live.size(); ++k) {
    const std::vector<double> row = numbers_of(lines[k + 2]);
    ASSERT_EQ(row.size(), 22U);
    EXPECT_NEAR(row[0], live[k].time, 1e-6);
    // The diagonal of the upper triangle, row by row.
    for (const std::size_t i : {1U, 7U, 12U, 16U, 19U, 21U}) {
      EXPECT_GT(row[i], 0.0);
      EXPECT_LT(row[i], 0.01);
    }
  }
}

TEST_F(Inputs, AFolderAndAVideoNeedACameraAndAStartOnly) {
  const std::string camera = sequence_ + "/camera.yaml";
  const std::string video = scratch_ / "clip.avi";
  cv::VideoWriter writer(video, cv::CAP_OPENCV_MJPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 30.0, {160, 120});
  ASSERT_TRUE(writer.isOpened());
  writer.set(cv::VIDEOWRITER_PROP_QUALITY, 100);
  for (int k = 0; k < frames; ++k) {
    cv::Mat3b bgr;
    const ColorImage color = read_color(rgb(k));
    color.convertTo(bgr, CV_8U, 255.0);
    cv::cvtColor(bgr, bgr, cv::COLOR_RGB2BGR);
    writer.write(bgr);
  }
  writer.release();
  for (const std::string& input : {sequence_ + "/rgb", video}) {
    const std::string out = scratch_ / "run";
    must_run({"track", input, "--camera", camera, "--start", start_, "--method", "interpolation", "--cloud", cloud_,
              "--out", out});
    const Trajectory trajectory = read_trajectory(out + "/trajectory.txt");
    ASSERT_EQ(trajectory.size(), static_cast<std::size_t>(frames)) << input;
    EXPECT_LT(largest_error(trajectory), 0.05) << input;
    const RunResult blind = run_odosplat(
        {"track", input, "--camera", camera, "--method", "interpolation", "--cloud", cloud_, "--out", out});
    EXPECT_EQ(blind.status, 2);
    EXPECT_NE(blind.err.find("--start"), std::string::npos) << blind.err;
  }
}

TEST_F(Inputs, TheExampleGivesTheProgramsPoses) {
  const std::string map = scratch_ / "map.ply";
  must_run({"train", sequence_, "--every", "5", "--cloud", cloud_, "--iterations", "40", "--out", map});
  const std::string out = scratch_ / "run";
  must_run({"track", sequence_ + "/rgb", "--camera", sequence_ + "/camera.yaml", "--start", start_, "--map", map,
            "--out", out});
  const Trajectory live = read_trajectory(out + "/trajectory_live.txt");
  std::vector<std::string> words{sequence_ + "/rgb/%04d.png", sequence_ + "/camera.yaml", map};
  for (const std::string& word : start_words()) words.push_back(word);
  const RunResult example = run_program(test::example(), words);
  ASSERT_EQ(example.status, 0) << example.err;
  const auto lines = lines_of(example.out);
  ASSERT_EQ(lines.size(), static_cast<std::size_t>(frames));
  ASSERT_EQ(live.size(), lines.size());
  for (std::size_t k = 0; k < lines.size(); ++k) {
    const std::vector<double> row = numbers_of(lines[k]);
    ASSERT_EQ(row.size(), 8U) << lines[k];
    EXPECT_NE(lines[k].find(" ok"), std::string::npos);
    // the video's grey values are rounded to 8 bits
    EXPECT_LT((Eigen::Vector3d(row[1], row[2], row[3]) - live[k].T_world_camera.translation()).norm(), 0.003) << k;
  }
  EXPECT_EQ(run_program(test::example(), {"0"}).status, 2);
}

}  // namespace
}  // namespace odosplat::apps_test
