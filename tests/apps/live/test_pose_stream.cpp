// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// --stream: lines of JSON, and readers that are slow, gone, or not there.
#include "apps/cli/track/pose_stream.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "odosplat/core/error.hpp"
#include "odosplat/io/trajectory/trajectory_file.hpp"
#include "tests/apps/live/live_world.hpp"
#include "tests/apps/run_program.hpp"
#include "tests/locations.hpp"

namespace odosplat::apps_test {
namespace {

using apps::InputFrame;
using apps::pose_line;
using apps::PoseStream;
using testing::HasSubstr;
using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Standard output of this process as a pipe, until the end of the object's life.
class PipedOutput {
 public:
  PipedOutput() : before_(dup(STDOUT_FILENO)) {
    std::fflush(stdout);
    if (pipe(ends_) != 0) return;
    dup2(ends_[1], STDOUT_FILENO);
    close(ends_[1]);
  }
  ~PipedOutput() {
    std::fflush(stdout);
    dup2(before_, STDOUT_FILENO);
    close(before_);
    close_reader();
  }
  void close_reader() {
    if (ends_[0] >= 0) close(ends_[0]);
    ends_[0] = -1;
  }
  /// What there is to be read.
  std::string read_some() const {
    std::string bytes(1 << 20, '\0');
    const ssize_t got = read(ends_[0], bytes.data(), bytes.size());
    return bytes.substr(0, got > 0 ? static_cast<std::size_t>(got) : 0);
  }

 private:
  int before_;
  int ends_[2] = {-1, -1};
};

TEST(PoseLine, HoldsTheSameNumbers) {
  InputFrame frame;
  frame.number = 7;
  frame.time = 1234.567891;
  TrackResult result;
  result.status = TrackStatus::relocalised;
  result.T_world_camera = SE3(so3_exp({0.1, -0.2, 1.0 / 3.0}), {1.0 / 7.0, -2e-17, 3e9});
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) result.covariance(i, j) = 1.0 / (3.0 + i + j);
  }
  result.in_map = true;
  result.evidence.verdict = Confirmation::confirmed;
  result.evidence.probability = 0.1 + 0.2;
  const std::string text = pose_line(frame, &result, 12.3);
  EXPECT_EQ(text.find('\n'), std::string::npos);
  const Json line = Json::parse(text);
  EXPECT_EQ(line["frame"], 7);
  EXPECT_EQ(line["time"].get<double>(), frame.time);
  EXPECT_EQ(line["status"], "relocalised");
  const std::vector<double> pose = line["pose"];
  const Eigen::Quaterniond& q = result.T_world_camera.rotation();
  EXPECT_THAT(pose, testing::ElementsAre(1.0 / 7.0, -2e-17, 3e9, q.x(), q.y(), q.z(), q.w()));
  const std::vector<double> covariance = line["covariance"];
  ASSERT_EQ(covariance.size(), 21U);
  EXPECT_EQ(covariance[1], result.covariance(0, 1));
  EXPECT_EQ(covariance[6], result.covariance(1, 1));
  EXPECT_EQ(covariance[20], result.covariance(5, 5));
  EXPECT_EQ(line["in_map"], true);
  EXPECT_EQ(line["confirmed"].get<double>(), 0.1 + 0.2);
  EXPECT_EQ(line["latency_ms"].get<double>(), 12.3);
}

TEST(PoseLine, OfALostFrameHasNoPose) {
  const Json unreadable = Json::parse(pose_line({}, nullptr, std::nullopt));
  EXPECT_EQ(unreadable["status"], "lost");
  for (const char* key : {"pose", "covariance", "confirmed", "latency_ms"}) {
    EXPECT_TRUE(unreadable.contains(key) && unreadable[key].is_null()) << key;
  }
  EXPECT_EQ(unreadable["in_map"], false);
  TrackResult lost;
  EXPECT_TRUE(Json::parse(pose_line({}, &lost, 3.0))["pose"].is_null());
}

TEST(PoseStream, NeverWaitsForASlowReader) {
  constexpr int lines = 5000;
  std::size_t sent = 0;
  std::size_t dropped = 0;
  std::string read;
  testing::internal::CaptureStderr();
  {
    PipedOutput output;
    PoseStream stream("-");
    const Clock::time_point start = Clock::now();
    for (int k = 0; k < lines; ++k) stream.send(std::string(900, 'x'));
    EXPECT_LT(seconds_since(start), 1.0);
    const Clock::time_point end = Clock::now();
    stream.finish();
    EXPECT_LT(seconds_since(end), 1.0);
    sent = stream.sent();
    dropped = stream.dropped();
    read = output.read_some();
  }
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(sent + dropped, 1U * lines);
  EXPECT_GT(sent, 50U);  // what a pipe holds
  EXPECT_GT(dropped, 3000U);
  EXPECT_EQ(count_of(log, "too slow"), 1U) << log;
  EXPECT_EQ(count_of(read, "\n"), sent);
}

TEST(PoseStream, EndsWhenItsReaderIsGone) {
  std::size_t sent = 0;
  testing::internal::CaptureStderr();
  {
    PipedOutput output;
    PoseStream stream("-");
    stream.send("{}");
    EXPECT_EQ(output.read_some(), "{}\n");
    output.close_reader();
    for (int k = 0; k < 50; ++k) {
      stream.send("{}");
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    stream.finish();
    sent = stream.sent();
    EXPECT_EQ(stream.dropped(), 50U);
  }
  EXPECT_EQ(sent, 1U);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_EQ(count_of(log, "its reader has closed it; tracking goes on"), 1U) << log;
}

TEST(PoseStream, ByUdpNeedsNoReader) {
  std::string address;
  {
    UdpReader reader;
    address = reader.address();
    PoseStream stream(address);
    stream.send("{\"a\":1}");
    stream.finish();
    for (int k = 0; k < 500 && reader.lines() == 0; ++k) std::this_thread::sleep_for(std::chrono::milliseconds(2));
    EXPECT_THAT(reader.finish(), testing::ElementsAre("{\"a\":1}\n"));
  }
  testing::internal::CaptureStderr();
  PoseStream stream(address);
  for (int k = 0; k < 20; ++k) {
    stream.send("{}");
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  stream.finish();
  EXPECT_EQ(stream.sent() + stream.dropped(), 20U);
  EXPECT_EQ(count_of(testing::internal::GetCapturedStderr(), "a line was not sent"), 1U);
}

TEST(PoseStream, RefusesOtherPlaces) {
  for (const char* where : {"file.json", "tcp://127.0.0.1:5", "udp://127.0.0.1", "udp://:5", "udp://127.0.0.1:0",
                            "udp://127.0.0.1:70000", "udp://127.0.0.1:5x", "udp://"}) {
    EXPECT_THROW(PoseStream stream(where), InputError) << where;
  }
  EXPECT_THROW(PoseStream("udp://no host:5"), InputError);
}

TEST(PoseStream, OfARecordedSequenceHasStandardOutputToItself) {
  LiveWorld world(20);
  const RunResult run = run_odosplat(world.track(world.sequence(), {"--stream", "-"}));
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("20 of 20 frames posed"));
  const Trajectory live = read_trajectory(world.out() + "/trajectory_live.txt");
  ASSERT_EQ(live.size(), 20U);
  std::istringstream in(run.out);
  std::size_t k = 0;
  for (std::string text; std::getline(in, text); ++k) {
    const Json line = Json::parse(text);  // nothing else is there
    EXPECT_EQ(line["frame"], k);
    EXPECT_NEAR(line["time"].get<double>(), live[k].time, 1e-6);
    EXPECT_NEAR(line["pose"][0].get<double>(), live[k].T_world_camera.translation().x(), 1e-6);
    EXPECT_TRUE(line["latency_ms"].is_null());
  }
  EXPECT_EQ(k, 20U);
  const Json report = Json::parse(read_text(world.out() + "/report.json"));
  EXPECT_FALSE(report.contains("live"));
  EXPECT_EQ(report["stream"]["sent"], 20);
}

TEST(PoseStream, AClosedPipeDoesNotEndTheRun) {
  LiveWorld world(20);
  std::string command = test::program();
  for (const std::string& word : world.track(world.sequence(), {"--stream", "-"})) command += " '" + word + "'";
  const std::string status = world.file("status");
  const std::string err = world.file("err");
  const std::string all = "( " + command + " 2>'" + err + "'; echo $? >'" + status + "' ) | true";
  ASSERT_EQ(std::system(all.c_str()), 0);
  EXPECT_EQ(read_text(status), "0\n") << read_text(err);
  EXPECT_EQ(count_of(read_text(err), "its reader has closed it"), 1U) << read_text(err);
  EXPECT_EQ(read_trajectory(world.out() + "/trajectory.txt").size(), 20U);
}

}  // namespace
}  // namespace odosplat::apps_test
