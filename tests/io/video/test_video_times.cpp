// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Time stamps and rotation of videos created by the program ffmpeg: they must be read as stored in the container.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/io/video/video_reader.hpp"
#include "odosplat/io/video/video_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

bool has_ffmpeg() { return std::system("ffmpeg -version >/dev/null 2>&1") == 0; }
#define FFMPEG_OR_SKIP() \
  if (!has_ffmpeg()) GTEST_SKIP() << "the program ffmpeg is not installed (Debian package ffmpeg)"

// Changing frame rates, pauses and irregular intervals.
const std::vector<int> uneven_ms{0,   20,  40,   60,   80,   100,  820,  840,  860,  880,
                                 961, 998, 1120, 1201, 1280, 4360, 4460, 4540, 4543, 4700};
std::vector<int> even_ms() {
  std::vector<int> times;
  for (int k = 0; k < 20; ++k) times.push_back(40 * k);
  return times;
}

int level(std::size_t k) { return 10 + 12 * static_cast<int>(k); }

// Frames at these times, each with a uniform grey level.
std::string make_video(const TempFolder& temp, const std::string& name, const std::vector<int>& ms,
                       const std::string& encoder) {
  std::string raw;
  std::string at;
  for (std::size_t k = 0; k < ms.size(); ++k) {
    raw += std::string(64 * 48 * 3, static_cast<char>(level(k)));
    at += (k > 0 ? "+" : "") + ("eq(N," + std::to_string(k)) + ")*" + std::to_string(ms[k]);
  }
  const std::string frames = temp.put("frames.rgb", raw);
  const std::string path = temp / name;
  const std::string command = "ffmpeg -nostdin -loglevel error -y -f rawvideo -pix_fmt rgb24 -s 64x48 -r 1000 -i '" +
                              frames + "' -vf \"setpts='(" + at + "+0.5)/1000/TB'\" -fps_mode passthrough " + encoder +
                              " '" + path + "'";
  EXPECT_EQ(std::system(command.c_str()), 0) << command;
  return path;
}

const std::string h264 = "-enc_time_base 1/1000 -c:v libx264 -crf 8 -bf 3 -pix_fmt yuv420p";
const std::string mpeg4 = "-enc_time_base 1/1000 -c:v mpeg4 -q:v 2 -bf 2";
// FFmpeg 7.1 gives the last of these frames no duration, so that the edit list of an MP4 file ends before it. Fragmented
// files have no such end; without B-frames a duration can be set.
const std::string fragments = " -movflags +frag_keyframe+delay_moov";

void expect_frames(const VideoReader& reader, std::size_t frames) {
  for (std::size_t k = 0; k < frames; ++k) {
    EXPECT_NEAR(cv::mean(reader.frame(k))[0], level(k), 5.0) << k;
  }
}

struct Clip {
  const char* name;
  std::string encoder;
};

TEST(VideoTimes, AreThePresentationStampsOfTheContainer) {
  FFMPEG_OR_SKIP();
  for (const Clip& clip :
       {Clip{"b.mp4", h264 + fragments}, Clip{"b.mkv", h264}, Clip{"b.mov", h264 + fragments},
        Clip{"m.mp4", mpeg4 + fragments}, Clip{"plain.mp4", h264 + " -bf 0 -bsf:v setts=duration=40"},
        Clip{"plain.mkv", "-enc_time_base 1/1000 -c:v mpeg4 -q:v 2"},
        Clip{"plain.avi", "-enc_time_base 1/1000 -c:v mpeg4 -q:v 2"},
        Clip{"jpeg.mkv", "-enc_time_base 1/1000 -c:v mjpeg -q:v 2"},
        Clip{"v.webm", "-enc_time_base 1/1000 -c:v libvpx-vp9 -crf 10 -b:v 0"}}) {
    SCOPED_TRACE(clip.name);
    const TempFolder temp;
    testing::internal::CaptureStderr();
    const VideoReader reader(make_video(temp, clip.name, uneven_ms, clip.encoder));
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // no warning about missing images
    ASSERT_EQ(reader.size(), uneven_ms.size());
    ASSERT_EQ(reader.times().size(), uneven_ms.size());
    for (std::size_t k = 0; k < uneven_ms.size(); ++k) EXPECT_NEAR(reader.times()[k], 0.001 * uneven_ms[k], 1e-3) << k;
    expect_frames(reader, uneven_ms.size());
  }
}

TEST(VideoTimes, StartWhereTheContainerStarts) {
  FFMPEG_OR_SKIP();
  const TempFolder temp;
  const VideoReader reader(make_video(temp, "b.ts", uneven_ms, h264));
  ASSERT_EQ(reader.times().size(), uneven_ms.size());
  EXPECT_GT(reader.times()[0], 1.0);  // a transport stream reserves time for its decoder
  for (std::size_t k = 0; k < uneven_ms.size(); ++k) {
    EXPECT_NEAR(reader.times()[k] - reader.times()[0], 0.001 * uneven_ms[k], 1e-3) << k;
  }
}

TEST(VideoTimes, ContainersWithoutStampsNeedAConstantRate) {
  FFMPEG_OR_SKIP();
  const TempFolder temp;
  const std::string rate = "-enc_time_base 1/25 -c:v mpeg4 -q:v 2 -bf 2";
  const VideoReader even(make_video(temp, "even.avi", even_ms(), rate));
  ASSERT_EQ(even.times().size(), 20U);
  for (std::size_t k = 0; k < 20; ++k) EXPECT_NEAR(even.times()[k], 0.04 * static_cast<double>(k), 1e-3) << k;
  expect_frames(even, 20);
  const std::string uneven = make_video(temp, "uneven.avi", uneven_ms, mpeg4);
  EXPECT_THAT(error_of([&] { VideoReader reader(uneven); }), HasSubstr("uneven.avi: has no presentation stamps"));
}

std::string camera(const TempFolder& temp, int width, int height, const std::string& more = "") {
  return temp.put("c.yaml", "width: " + std::to_string(width) + "\nheight: " + std::to_string(height) +
                                "\nfx: 60\nfy: 60\ncx: 31.5\ncy: 23.5\n" + more);
}

TEST(VideoTimes, BareStreamsTakeTheRateOfTheCameraFile) {
  FFMPEG_OR_SKIP();
  const TempFolder temp;
  const std::string path = make_video(temp, "bare.h264", even_ms(), h264);
  EXPECT_TRUE(VideoReader(path).times().empty());
  SequenceOptions options;
  options.camera_file = camera(temp, 64, 48);
  EXPECT_THAT(error_of([&] { Sequence::open(path, options); }), HasSubstr("give fps in the camera file"));
  options.camera_file = camera(temp, 64, 48, "fps: 20\n");
  EXPECT_NEAR(Sequence::open(path, options).time(3), 0.15, 1e-9);
}

TEST(VideoTimes, CountBeforeTheRateOfTheCameraFile) {
  FFMPEG_OR_SKIP();
  const TempFolder temp;
  const std::string path = make_video(temp, "b.mp4", uneven_ms, h264 + fragments);
  SequenceOptions options;
  options.camera_file = camera(temp, 64, 48, "fps: 240\n");
  testing::internal::CaptureStderr();
  const Sequence s = Sequence::open(path, options);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("says 240.000 frames per second, the video's stamps"));
  ASSERT_EQ(s.size(), uneven_ms.size());
  EXPECT_NEAR(s.time(6), 0.82, 1e-3);
  EXPECT_EQ(s.time_text(15), "4.360000");
  EXPECT_NEAR(cv::mean(s.color(19))[0] * 255.0, level(19), 5.0);
}

TEST(VideoTimes, OpeningTellsHowMuchIsReadAndCanBeEnded) {
  FFMPEG_OR_SKIP();
  const TempFolder temp;
  const std::string path = make_video(temp, "m.mkv", uneven_ms, "-enc_time_base 1/1000 -c:v mjpeg");
  SequenceOptions options;
  options.camera_file = camera(temp, 64, 48);
  std::vector<double> shares;
  options.progress = [&](double share) { shares.push_back(share); };
  Sequence::open(path, options);
  EXPECT_EQ(shares.size(), uneven_ms.size());
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_LE(shares.back(), 1.0);
  EXPECT_GT(shares.back(), 0.9);
  options.progress = [](double) { throw Interrupted(); };
  EXPECT_THROW(Sequence::open(path, options), Interrupted);
}

TEST(VideoTimes, ADamagedEndLosesFramesAndNoStamps) {
  FFMPEG_OR_SKIP();
  const TempFolder temp;
  const std::string bytes = read_file(make_video(temp, "whole.mkv", uneven_ms, "-enc_time_base 1/1000 -c:v mjpeg"));
  const VideoReader cut(temp.put("cut.mkv", bytes.substr(0, 2 * bytes.size() / 3)));
  ASSERT_GE(cut.size(), 5U);
  EXPECT_LT(cut.size(), uneven_ms.size());
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(cut.times()[k], 0.001 * uneven_ms[k], 1e-3) << k;
}

// An MP4 whose track matrix is x' = a x + c y, y' = b x + d y; the top left quarter of the stored image is bright.
std::string with_matrix(const TempFolder& temp, int a, int b, int c, int d) {
  const std::string path = temp / "clip.mp4";
  VideoWriter writer(path, {64, 48}, 25.0);
  cv::Mat3b image(48, 64, cv::Vec3b::all(30));
  image(cv::Rect(0, 0, 32, 24)).setTo(cv::Vec3b::all(220));
  for (int k = 0; k < 5; ++k) writer.write(image);
  writer.commit();
  std::string bytes = read_file(path);
  const std::size_t matrix = bytes.find("tkhd") + 4 + 40;  // in a track header of version 0
  const auto put = [&](std::size_t place, int value) {
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[matrix + 4 * place + i] = static_cast<char>((static_cast<std::uint32_t>(value) << 16) >> (8 * (3 - i)));
    }
  };
  put(0, a);
  put(1, b);
  put(3, c);
  put(4, d);
  return temp.put("turned.mp4", bytes);
}

TEST(VideoTurn, ImagesAreTurnedAsTheyAreToBeShown) {
  const TempFolder temp;
  const struct {
    int a, b, c, d;
    cv::Size size;
    cv::Point bright;  // a pixel of the bright quarter
  } turns[] = {{1, 0, 0, 1, {64, 48}, {5, 5}},
               {0, 1, -1, 0, {48, 64}, {43, 5}},
               {-1, 0, 0, -1, {64, 48}, {59, 43}},
               {0, -1, 1, 0, {48, 64}, {5, 59}}};
  for (int quarters = 0; quarters < 4; ++quarters) {
    const auto& turn = turns[quarters];
    SCOPED_TRACE(quarters);
    const VideoReader reader(with_matrix(temp, turn.a, turn.b, turn.c, turn.d));
    EXPECT_EQ(reader.quarters(), quarters);
    EXPECT_EQ(reader.frame_size(), turn.size);
    const cv::Mat3b image = reader.frame(2);
    ASSERT_EQ(image.size(), turn.size);
    int bright = 0;
    for (const cv::Vec3b& pixel : image) bright += pixel[0] > 125 ? 1 : 0;
    EXPECT_NEAR(bright, 64 * 48 / 4, 60);
    EXPECT_GT(image(turn.bright)[0], 125);
  }
}

TEST(VideoTurn, TheCameraMustBeOfTheImagesAsTheyAreShown) {
  const TempFolder temp;
  SequenceOptions options;
  const std::string upright = with_matrix(temp, 0, 1, -1, 0);
  options.camera_file = camera(temp, 48, 64);
  EXPECT_EQ(Sequence::open(upright, options).color(0).size(), cv::Size(48, 64));
  options.camera_file = camera(temp, 48, 64, "line_time: 1e-4\n");
  EXPECT_THAT(error_of([&] { Sequence::open(upright, options); }), HasSubstr("line_time of " + temp / "c.yaml"));
  options.camera_file = camera(temp, 64, 48);
  EXPECT_THAT(error_of([&] { Sequence::open(upright, options); }),
              HasSubstr("is shown turned by 90 degrees clockwise, as 48x64; " + temp / "c.yaml" + " is for 64x48"));
  const std::string upside_down = with_matrix(temp, -1, 0, 0, -1);
  testing::internal::CaptureStderr();
  Sequence::open(upside_down, options);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("turned by 180 degrees clockwise"));
}

TEST(VideoTurn, MirroredAndSlantedVideosAreRefused) {
  const TempFolder temp;
  EXPECT_THAT(error_of([&] { VideoReader reader(with_matrix(temp, -1, 0, 0, 1)); }), HasSubstr("shown mirrored"));
  EXPECT_THAT(error_of([&] { VideoReader reader(with_matrix(temp, 1, 1, -1, 1)); }),
              HasSubstr("turned by 45.0 degrees"));
}

}  // namespace
}  // namespace odosplat
