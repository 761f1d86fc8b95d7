// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/video/live_address.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

TEST(LiveAddress, TellsLiveSourcesFromFiles) {
  const test::TempFolder temp;
  ASSERT_EQ(mkfifo((temp / "fifo").c_str(), 0600), 0);
  temp.put("clip.mp4", "no video");
  EXPECT_EQ(live_kind("-"), LiveKind::pipe);
  EXPECT_EQ(live_kind(temp / "fifo"), LiveKind::pipe);
  EXPECT_EQ(live_kind("/dev/null"), LiveKind::device);
  EXPECT_EQ(live_kind("rtsp://camera/stream"), LiveKind::network);
  EXPECT_EQ(live_kind("udp://@:1234"), LiveKind::network);
  EXPECT_EQ(live_kind("rtmp+tls.x-1://host"), LiveKind::network);
  EXPECT_EQ(live_kind(temp / "clip.mp4"), LiveKind::none);
  EXPECT_EQ(live_kind(temp.path()), LiveKind::none);
  EXPECT_EQ(live_kind("/dev/no_such_camera"), LiveKind::none);
  EXPECT_EQ(live_kind("a folder/x://y"), LiveKind::none);
  EXPECT_EQ(live_kind("://x"), LiveKind::none);
  EXPECT_EQ(live_kind(""), LiveKind::none);
}

TEST(LiveAddress, IsShownWithoutSecrets) {
  EXPECT_EQ(shown_address("rtsp://user:pass@host:554/a?b=1"), "rtsp://user:***@host:554/a?b=1");
  EXPECT_EQ(shown_address("rtsp://user@host/a"), "rtsp://user@host/a");
  EXPECT_EQ(shown_address("rtsp://:pass@host"), "rtsp://:***@host");
  EXPECT_EQ(shown_address("rtsp://user:p@ss:w@host/a"), "rtsp://user:***@host/a");
  EXPECT_EQ(shown_address("rtsp://user:pa/ss@host/a"), "rtsp://user:***@host/a");
  EXPECT_EQ(shown_address("rtsp://user:pa?ss#@host/a"), "rtsp://user:***@host/a");
  EXPECT_EQ(shown_address("http://host:8080/by@name"), "http://host:8080/by@name");
  EXPECT_EQ(shown_address("http://host/v?user=me&Password=se%20cret&x=1;access_token=abc"),
            "http://host/v?user=me&Password=***&x=1;access_token=***");
  EXPECT_EQ(shown_address("http://u:s@[::1]:80/?pwd="), "http://u:***@[::1]:80/?pwd=***");
  EXPECT_EQ(shown_address("udp://@:1234"), "udp://@:1234");
  EXPECT_EQ(shown_address("a:b@c?key=d"), "a:b@c?key=d");  // a file's name
  EXPECT_EQ(shown_address("-"), "-");
}

}  // namespace
}  // namespace odosplat
