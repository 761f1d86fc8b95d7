// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Live sources: streams that the test itself writes into pipes and sockets.
#include "odosplat/io/video/live_source.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

#include "odosplat/core/error.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/io/video/y4m_stream.hpp"

namespace odosplat {
namespace {

using namespace test;
using std::chrono::milliseconds;
using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

LiveOptions quick(double reconnect = 0.0) {
  LiveOptions options;
  options.open_timeout = 2.0;
  options.stall_timeout = 3.0;
  options.reconnect = reconnect;
  return options;
}

/// Number of the image as its grey level shows it. Grey 16 to 235 of the stream is 0 to 255 of the image.
std::size_t number_shown(const LiveFrame& frame) {
  const double level = 16.0 + frame.rgb(24, 32)[0] * 219.0 / 255.0;
  return static_cast<std::size_t>(std::lround((level - 20.0) / 2.0));
}

/// A FIFO with a thread that writes what it is told.
class LivePipe : public testing::Test {
 protected:
  LivePipe() { mkfifo(path_.c_str(), 0600); }
  ~LivePipe() override {
    stop_ = true;
    if (writer_.joinable()) writer_.join();
  }
  template <typename Write>
  void write(Write work) {
    writer_ = std::thread([this, work] {
      int file = -1;
      while (file < 0 && !stop_) {  // without waiting for ever for a reader
        file = open(path_.c_str(), O_WRONLY | O_NONBLOCK);
        std::this_thread::sleep_for(milliseconds(1));
      }
      if (file < 0) return;
      fcntl(file, F_SETFL, 0);
      work(file);
      close(file);
    });
  }

  const TempFolder temp_;
  const std::string path_ = temp_ / "fifo";
  std::atomic<bool> stop_{false};
  std::thread writer_;
};

TEST_F(LivePipe, GivesEveryImageToACallerInTime) {
  write([](int file) {
    write_all(file, y4m_header());
    for (std::size_t k = 0; k < 40; ++k) {
      write_all(file, y4m_image(k));
      std::this_thread::sleep_for(milliseconds(20));
    }
  });
  LiveSource source(path_, quick());
  EXPECT_EQ(source.size(), cv::Size(64, 48));
  std::this_thread::sleep_for(milliseconds(200));  // a pipe waits for the caller
  source.start();
  std::vector<LiveFrame> frames;
  std::size_t dropped = 0;
  while (!source.ended()) {
    const std::optional<LiveFrame> frame = source.take(0.05);
    if (!frame) continue;
    EXPECT_EQ(number_shown(*frame), frame->number);
    if (!frames.empty()) {
      EXPECT_EQ(frame->number, frames.back().number + frame->dropped + 1);
      const double step = 0.02 * static_cast<double>(frame->dropped + 1);  // by the stamps, whatever the arrival
      EXPECT_NEAR(frame->time - frames.back().time, step, 0.006 * step + 1e-5);
    }
    dropped += frame->dropped;
    frames.push_back(*frame);
  }
  ASSERT_GT(frames.size(), 20U);
  EXPECT_EQ(frames[0].number, 0U);
  EXPECT_EQ(frames.size() + dropped, 40U);
  EXPECT_EQ(source.counts().images, 40U);
  EXPECT_EQ(source.counts().dropped, dropped);
  EXPECT_EQ(frames.back().number, 39U);
}

TEST_F(LivePipe, DropsAllButTheNewestForALateCaller) {
  write([](int file) { write_all(file, y4m_header() + y4m_images(0, 60)); });
  LiveSource source(path_, quick());
  source.start();
  std::this_thread::sleep_for(milliseconds(700));
  const std::optional<LiveFrame> frame = source.take(1.0);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->number, 59U);
  EXPECT_EQ(number_shown(*frame), 59U);
  EXPECT_EQ(frame->dropped, 59U);
  EXPECT_TRUE(source.ended());
  EXPECT_FALSE(source.take(1.0));
}

TEST_F(LivePipe, SaysThatImagesComeFasterThanTheirStamps) {
  write([](int file) { write_all(file, y4m_header() + y4m_images(0, 400)); });  // 8 s of stamps
  testing::internal::CaptureStderr();
  LiveSource source(path_, quick());
  source.start();
  while (!source.ended()) source.take(0.01);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("come faster than their stamps say"));
}

TEST_F(LivePipe, ThatFallsSilentEnds) {
  write([this](int file) {
    write_all(file, y4m_header() + y4m_images(0, 3));
    while (!stop_) std::this_thread::sleep_for(milliseconds(5));
  });
  testing::internal::CaptureStderr();
  LiveOptions options = quick(0.5);
  options.stall_timeout = 0.4;
  LiveSource source(path_, options);
  source.start();
  const Clock::time_point start = Clock::now();
  while (!source.ended()) source.take(0.05);
  EXPECT_GT(seconds_since(start), 0.8);
  EXPECT_LT(seconds_since(start), 3.0);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr("fifo: no image for 0.4 s; it is waited for 0.5 s more"));
  EXPECT_THAT(log, HasSubstr("fifo: has ended (no image for 0.4 s)"));
}

TEST_F(LivePipe, WithoutAWriterGivesUp) {
  LiveOptions options = quick();
  options.open_timeout = 0.3;
  const Clock::time_point start = Clock::now();
  EXPECT_THAT(error_of([&] { LiveSource source(path_, options); }), HasSubstr("fifo: no image came within 0.3 s"));
  EXPECT_LT(seconds_since(start), 2.0);
}

TEST_F(LivePipe, WithoutAVideoIsRefused) {
  write([](int file) { write_all(file, std::string(100'000, 'x')); });
  EXPECT_THAT(error_of([&] { LiveSource source(path_, quick()); }), HasSubstr("fifo: cannot be opened: "));
}

TEST_F(LivePipe, IsLeftAtOnceWhenStopped) {
  std::atomic<bool> stop{false};
  std::thread later([&stop] {
    std::this_thread::sleep_for(milliseconds(200));
    stop = true;
  });
  const Clock::time_point start = Clock::now();
  EXPECT_THROW(LiveSource(path_, quick(), [&stop] { return stop.load(); }), Interrupted);
  EXPECT_LT(seconds_since(start), 1.0);
  later.join();
}

TEST_F(LivePipe, IsClosedAtOnceWhileItIsRead) {
  write([this](int file) {
    write_all(file, y4m_header() + y4m_images(0, 3));
    while (!stop_) std::this_thread::sleep_for(milliseconds(5));
  });
  LiveOptions options;  // patient
  Clock::time_point start;
  {
    LiveSource source(path_, options);
    source.start();
    while (source.take(0.2)) {
    }
    start = Clock::now();
  }
  EXPECT_LT(seconds_since(start), 0.5);
}

TEST(LiveNetwork, IsOpenedAgainWhenItCloses) {
  const TcpServer server;
  std::atomic<bool> stop{false};
  std::thread serving([&] {
    for (int connection = 0; connection < 2; ++connection) {
      const int client = server.accept_client();
      write_all(client, y4m_header());
      for (std::size_t k = 0; k < 15; ++k) {
        write_all(client, y4m_image(k));
        std::this_thread::sleep_for(milliseconds(20));
      }
      close(client);
    }
  });
  testing::internal::CaptureStderr();
  double last = 0.0;
  double longest = 0.0;
  std::size_t frames = 0;
  LiveSource source(server.address(), quick(1.5));
  source.start();
  while (!source.ended()) {
    const std::optional<LiveFrame> frame = source.take(0.05);
    if (!frame) continue;
    EXPECT_GT(frame->time, last);
    if (frames++ > 0) longest = std::max(longest, frame->time - last);
    last = frame->time;
  }
  serving.join();
  EXPECT_GT(frames, 15U);
  EXPECT_GT(longest, 0.4);  // while nothing came
  EXPECT_EQ(source.counts().reconnections, 1U);
  const std::string log = testing::internal::GetCapturedStderr();
  EXPECT_THAT(log, HasSubstr(server.address() + ": lost (its other end has closed it)"));
  EXPECT_THAT(log, HasSubstr("is back after "));
  EXPECT_THAT(log, HasSubstr(": has ended ("));
}

TEST(LiveNetwork, ThatFallsSilentIsLost) {
  const TcpServer server;
  std::atomic<bool> stop{false};
  std::thread serving([&] {
    const int client = server.accept_client();
    write_all(client, y4m_header() + y4m_images(0, 5));
    while (!stop) std::this_thread::sleep_for(milliseconds(5));
    close(client);
  });
  testing::internal::CaptureStderr();
  LiveOptions options = quick();
  options.stall_timeout = 0.4;
  LiveSource source(server.address(), options);
  source.start();
  const Clock::time_point start = Clock::now();
  while (!source.ended()) source.take(0.05);
  EXPECT_LT(seconds_since(start), 2.0);
  stop = true;
  serving.join();
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("has ended (no image for 0.4 s)"));
}

TEST(LiveNetwork, ThatCannotBeOpenedIsNamedWithoutItsPassword) {
  std::string address;
  {
    const TcpServer server;
    address = "rtsp://me:secret@127.0.0.1:" + std::to_string(server.port()) + "/cam?token=secret";
  }
  const std::string error = error_of([&] { LiveSource source(address, quick()); });
  EXPECT_THAT(error, HasSubstr("rtsp://me:***@127.0.0.1:"));
  EXPECT_THAT(error, HasSubstr("cannot be opened: Connection refused"));
  EXPECT_EQ(error.find("secret"), std::string::npos);
}

TEST(LiveNetwork, ThatNeverAnswersGivesUp) {
  const TcpServer server;  // takes the connection, and says nothing
  LiveOptions options = quick();
  options.open_timeout = 0.4;
  for (const std::string& address :
       {server.address(), "rtsp://127.0.0.1:" + std::to_string(server.port()) + "/x",
        "http://127.0.0.1:" + std::to_string(server.port()) + "/x", std::string("udp://127.0.0.1:38491")}) {
    SCOPED_TRACE(address);
    const Clock::time_point start = Clock::now();
    EXPECT_THAT(error_of([&] { LiveSource source(address, options); }), HasSubstr("no image came within 0.4 s"));
    EXPECT_LT(seconds_since(start), 2.0);
  }
}

TEST(LiveSource, OthersAreRefused) {
  EXPECT_THAT(error_of([] { LiveSource source("no_such_thing"); }), HasSubstr("is no live source"));
  EXPECT_THAT(error_of([] { LiveSource source("/dev/null"); }), HasSubstr("/dev/null: cannot be opened"));
  EXPECT_THAT(error_of([] { LiveSource source("gopher+x://a/b"); }), HasSubstr("gopher+x://a/b: cannot be opened"));
  LiveOptions wrong;
  wrong.reconnect = -1.0;
  EXPECT_THAT(error_of([&] { LiveSource source("-", wrong); }), HasSubstr("reconnect"));
}

}  // namespace
}  // namespace odosplat
