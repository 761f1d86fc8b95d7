// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Videos that are damaged or truncated, and files that are not videos.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>

#include "odosplat/io/video/video_reader.hpp"
#include "odosplat/io/video/video_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::AllOf;
using testing::HasSubstr;

constexpr std::size_t frames = 12;

std::string bytes_of_video(const TempFolder& temp, const std::string& name) {
  VideoWriter writer(temp / name, {64, 48}, 10.0);
  for (std::size_t k = 0; k < frames; ++k) writer.write(cv::Mat3b(48, 64, cv::Vec3b::all(static_cast<uchar>(20 * k))));
  writer.commit();
  return read_file(temp / name);
}

/// Position and length of the data of image k in an AVI.
std::pair<std::size_t, std::size_t> chunk(const std::string& avi, std::size_t k) {
  std::size_t at = avi.find("movi");
  for (std::size_t i = 0; i <= k; ++i) at = avi.find("00dc", at + 4);
  std::uint32_t size = 0;
  for (std::size_t i = 0; i < 4; ++i)
    size |= static_cast<std::uint32_t>(static_cast<unsigned char>(avi[at + 4 + i])) << (8 * i);
  return {at + 8, size};
}

struct Said {
  std::size_t size = 0;
  std::vector<double> times;
  std::string warnings;
};
Said read(const std::string& path) {
  testing::internal::CaptureStderr();
  const VideoReader reader(path);
  return {reader.size(), reader.times(), testing::internal::GetCapturedStderr()};
}

TEST(VideoDamage, AWholeVideoIsReadInSilence) {
  const TempFolder temp;
  for (const char* name : {"a.avi", "a.mp4"}) {
    bytes_of_video(temp, name);
    const Said said = read(temp / name);
    EXPECT_EQ(said.size, frames);
    EXPECT_EQ(said.warnings, "") << name;
  }
}

TEST(VideoDamage, AnImageThatIsMissingIsToldAndThatTheStampsShift) {
  const TempFolder temp;
  std::string avi = bytes_of_video(temp, "a.avi");
  avi.replace(chunk(avi, 4).first - 8, 4, "JUNK");
  const Said said = read(temp.put("junk.avi", avi));
  EXPECT_EQ(said.size, frames - 1);
  EXPECT_THAT(said.warnings,
              AllOf(HasSubstr("junk.avi: is damaged or cut off: 11 images are read, 1 that the file declares "
                              "are missing"),
                    HasSubstr("those behind a missing one are too early")));
  // Without the index at the file's end, the number is in its header.
  const Said bare = read(temp.put("bare.avi", avi.substr(0, avi.rfind("idx1"))));
  EXPECT_EQ(bare.size, frames - 1);
  EXPECT_THAT(bare.warnings, HasSubstr("1 that the file declares are missing"));
}

TEST(VideoDamage, AFileThatIsCutOffSaysHowMuchIsMissing) {
  const TempFolder temp;
  const std::string avi = bytes_of_video(temp, "a.avi");
  const Said half = read(temp.put("half.avi", avi.substr(0, chunk(avi, 5).first + chunk(avi, 5).second / 2)));
  EXPECT_LE(half.size, 6U);
  EXPECT_GE(half.size, 5U);
  EXPECT_THAT(half.warnings, AllOf(HasSubstr("half.avi: is damaged or cut off"), HasSubstr("that the file declares")));
}

TEST(VideoDamage, ImagesWithoutDataAreCounted) {
  const TempFolder temp;
  std::string avi = bytes_of_video(temp, "a.avi");
  for (const std::size_t k : {3U, 7U}) {
    const auto [at, size] = chunk(avi, k);
    avi.replace(at, size, std::string(size, '\0'));
  }
  const Said said = read(temp.put("zero.avi", avi));
  EXPECT_EQ(said.size, frames - 2);
  EXPECT_THAT(said.warnings, HasSubstr("zero.avi: is damaged or cut off: 10 images are read, 2 cannot be decoded"));
  // The container counts the images that cannot be decoded, so the others keep their time stamps.
  EXPECT_NEAR(said.times.at(3), 0.4, 1e-3);
  EXPECT_NEAR(said.times.at(9), 1.1, 1e-3);
}

TEST(VideoDamage, MatroskaEndsBeforeItsHeaderSays) {
  if (std::system("ffmpeg -version >/dev/null 2>&1") != 0) GTEST_SKIP() << "the program ffmpeg is not installed";
  const TempFolder temp;
  bytes_of_video(temp, "a.avi");
  const std::string to_mkv = "ffmpeg -nostdin -loglevel error -y -i '" + temp / "a.avi" + "' ";
  ASSERT_EQ(std::system((to_mkv + "-c copy '" + temp / "a.mkv" + "'").c_str()), 0);
  EXPECT_EQ(read(temp / "a.mkv").warnings, "");
  const std::string mkv = read_file(temp / "a.mkv");
  const Said half = read(temp.put("half.mkv", mkv.substr(0, 6 * mkv.size() / 10)));
  EXPECT_LT(half.size, frames);
  EXPECT_THAT(half.warnings, HasSubstr("before its header says"));
  // Formats that declare their streams late or have no index.
  for (const char* name : {"b.flv", "b.ts", "b.mov", "b.webm"}) {
    const std::string kind = std::string(name).substr(2);
    const std::string encoder = kind == "webm" ? "libvpx" : kind == "flv" ? "flv" : "mpeg2video -r 25";
    ASSERT_EQ(std::system((to_mkv + "-c:v " + encoder + " '" + temp / name + "'").c_str()), 0) << name;
    EXPECT_EQ(read(temp / name).warnings, "") << name;
  }
  // Another stream may be longer, and an edit list may hide images on purpose.
  ASSERT_EQ(std::system((to_mkv + "-f lavfi -i sine=duration=3 -c:v copy '" + temp / "sound.mkv" + "'").c_str()), 0);
  EXPECT_EQ(read(temp / "sound.mkv").warnings, "");
  ASSERT_EQ(
      std::system((to_mkv + "-c:v mpeg4 '" + temp / "b.mp4" + "' && ffmpeg -nostdin -loglevel error -y -ss 0.5 -i '" +
                   temp / "b.mp4" + "' -c copy '" + temp / "cut.mp4" + "'")
                      .c_str()),
      0);
  EXPECT_EQ(read(temp / "cut.mp4").warnings, "");
}

// FFmpeg would open the files that a list or playlist names, even pipes.
TEST(VideoDamage, ListsOfOtherFilesAreNoVideos) {
  const TempFolder temp;
  bytes_of_video(temp, "a.avi");
  ASSERT_EQ(mkfifo((temp / "pipe.avi").c_str(), 0600), 0);
  for (const char* target : {"a.avi", "pipe.avi"}) {
    for (const std::string& list :
         {"ffconcat version 1.0\nfile " + std::string(target) + "\n",
          "#EXTM3U\n#EXT-X-TARGETDURATION:10\n#EXTINF:9.0,\n" + temp / target + "\n#EXT-X-ENDLIST\n"}) {
      const std::string path = temp.put("list.avi", list);
      EXPECT_EQ(error_of([&] { VideoReader reader(path); }), path + ": is not a video that can be read") << list;
    }
  }
}

}  // namespace
}  // namespace odosplat
