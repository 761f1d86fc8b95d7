// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <opencv2/core.hpp>

#include "odosplat/core/error.hpp"
#include "odosplat/io/video/video_reader.hpp"
#include "odosplat/io/video/video_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

std::size_t files_in(const std::string& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(VideoWriter, WritesWhatTheReaderReads) {
  const TempFolder temp;
  for (const char* name : {"new/clip.avi", "new/clip.mp4"}) {
    const std::string path = temp / name;
    VideoWriter writer(path, {64, 48}, 12.0);
    for (int k = 0; k < 5; ++k) writer.write(cv::Mat3b(48, 64, cv::Vec3b(200, 20, static_cast<unsigned char>(50 * k))));
    EXPECT_FALSE(std::filesystem::exists(path)) << "seen before it is whole";
    writer.commit();
    const VideoReader reader(path);
    EXPECT_EQ(reader.size(), 5U);
    for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(reader.times().at(k), static_cast<double>(k) / 12.0, 1e-4);
    ASSERT_EQ(reader.frame_size(), cv::Size(64, 48));
    for (std::size_t k = 0; k < 5; ++k) {
      const cv::Vec3b pixel = reader.frame(k)(24, 32);
      EXPECT_NEAR(pixel[0], 200, 12);
      EXPECT_NEAR(pixel[1], 20, 12);
      EXPECT_NEAR(pixel[2], 50.0 * static_cast<double>(k), 12);
    }
  }
  EXPECT_EQ(files_in(temp / "new"), 2U);
}

TEST(VideoWriter, AFilmThatIsCutOffIsAnError) {
  const TempFolder temp;
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
  for (const char* name : {"clip.avi", "clip.mp4"}) {
    rlimit small = limit;
    small.rlim_cur = 20'000;
    VideoWriter writer(temp / name, {160, 120}, 12.0);
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    cv::Mat3b noise(120, 160);
    for (int k = 0; k < 60; ++k) {
      cv::randu(noise, 0, 255);
      writer.write(noise);
    }
    EXPECT_THAT(error_of([&] { writer.commit(); }), HasSubstr("of 60 frames got there")) << name;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_FALSE(std::filesystem::exists(temp / name)) << name;
  }
  std::signal(SIGXFSZ, before);
}

TEST(VideoWriter, LeavesNothingWithoutCommit) {
  const TempFolder temp;
  {
    VideoWriter writer(temp / "clip.avi", {64, 48}, 12.0);
    writer.write(cv::Mat3b(48, 64, cv::Vec3b(1, 2, 3)));
  }
  EXPECT_EQ(files_in(temp.path()), 0U);
}

TEST(VideoWriter, WritesThroughALinkAndKeepsTheMode) {
  const TempFolder temp;
  std::filesystem::permissions(temp.put("disk/old.avi", "old"), std::filesystem::perms(0600));
  std::filesystem::create_symlink(temp / "disk/old.avi", temp / "clip.avi");
  VideoWriter writer(temp / "clip.avi", {64, 48}, 12.0);
  writer.write(cv::Mat3b(48, 64, cv::Vec3b(1, 2, 3)));
  writer.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(temp / "clip.avi"));
  EXPECT_EQ(std::filesystem::status(temp / "disk/old.avi").permissions(), std::filesystem::perms(0600));
  EXPECT_EQ(VideoReader(temp / "clip.avi").size(), 1U);
  EXPECT_EQ(files_in(temp / "disk"), 1U);
}

TEST(VideoWriter, RefusesWhatItCannotWrite) {
  const TempFolder temp;
  EXPECT_THAT(error_of([&] { VideoWriter(temp / "a.gif", {64, 48}, 30.0); }), HasSubstr("must end in .avi or .mp4"));
  EXPECT_THAT(error_of([&] { VideoWriter(temp / "a.avi", {63, 48}, 30.0); }), HasSubstr("size of a video"));
  EXPECT_THAT(error_of([&] { VideoWriter(temp / "a.avi", {64, 48}, 0.0); }), HasSubstr("frames a second"));
  temp.put("file", "x");
  EXPECT_THAT(error_of([&] { VideoWriter(temp / "file/a.avi", {64, 48}, 30.0); }), HasSubstr("cannot be written"));
  VideoWriter writer(temp / "b.avi", {64, 48}, 30.0);
  EXPECT_THROW(writer.write(cv::Mat3b(10, 10)), InputError);
  EXPECT_EQ(files_in(temp.path()), 2U) << "the file that was put there and the one being written";
}

}  // namespace
}  // namespace odosplat
