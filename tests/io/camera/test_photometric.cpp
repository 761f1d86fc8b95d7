// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/photometric.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/sequence/moved_sequence.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr int width = 40;
constexpr int height = 30;
const std::string camera_yaml = "width: 40\nheight: 30\nfx: 40\nfy: 40\ncx: 19.5\ncy: 14.5\n";

// Radiance, different in each channel; values from 0.03 to 0.43 do not saturate at twice the exposure.
cv::Vec3f radiance(int x, int y) {
  const float v = 0.03F + 0.4F * static_cast<float>(x * y % 37) / 37.0F;
  return {v, 0.7F * v + 0.02F, 0.02F + 0.3F * v};
}

// Brightness decreases to one half in the corners.
cv::Mat1f vignette() {
  cv::Mat1f v(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      v(y, x) = 1.0F - 0.5F * static_cast<float>((std::pow(x - 19.5, 2) + std::pow(y - 14.5, 2)) /
                                                 (std::pow(19.5, 2) + std::pow(14.5, 2)));
    }
  }
  return v;
}

// The image that a camera stores for this response, vignette and exposure.
ColorImage stored(double gamma, const cv::Mat1f& v, double exposure) {
  ColorImage image(height, width);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float share = static_cast<float>(exposure) * (v.empty() ? 1.0F : v(y, x));
      for (int c = 0; c < 3; ++c) {
        image(y, x)[c] = std::min(1.0F, std::pow(share * radiance(x, y)[c], static_cast<float>(1.0 / gamma)));
      }
    }
  }
  return image;
}

bool same_pixels(const ColorImage& a, const ColorImage& b) { return cv::norm(a, b, cv::NORM_INF) == 0.0; }

// Three frames at 1, 2 and 3 s with exposures 4, 2 and 8 (median 4), as 8-bit files. Corrected images should equal
// those of exposure 1 without vignette to one or two grey levels.
void put_darkened(const TempFolder& temp, double gamma, bool vignetted) {
  std::string list;
  std::string truth;
  const double exposures[] = {4, 2, 8};
  for (int k = 0; k < 3; ++k) {
    const std::string stamp = std::to_string(k + 1) + ".0";
    write_color(temp / (stamp + ".png"), stored(gamma, vignetted ? vignette() : cv::Mat1f(), exposures[k] / 4.0));
    list += stamp + " " + stamp + ".png\n";
    truth += stamp + " 0 0 0 0 0 0 1\n";
  }
  temp.put("rgb.txt", list);
  temp.put("groundtruth.txt", truth);
  if (vignetted) {
    cv::Mat1w file;
    vignette().convertTo(file, CV_16U, 50000.0);  // the largest value corresponds to 1
    write_png16(temp / "vignette.png", file);
  }
  temp.put("camera.yaml",
           camera_yaml + "gamma: " + std::to_string(gamma) + "\n" + (vignetted ? "vignette: vignette.png\n" : ""));
  temp.put("exposures.txt", "# time exposure\n1.001 4\n2.0 2\n2.999 8\n");
}

double largest_difference(const ColorImage& a, const ColorImage& b) { return cv::norm(a, b, cv::NORM_INF); }

TEST(Photometric, DarkenedImagesComeBack) {
  for (const double gamma : {1.0, 2.2}) {
    const PhotometricCorrection correction(gamma, vignette());
    for (const double exposure : {0.4, 1.0, 1.7}) {
      const ColorImage corrected = correction.apply(stored(gamma, vignette(), exposure), exposure);
      EXPECT_LT(largest_difference(corrected, stored(gamma, {}, 1.0)), 1e-5) << gamma << " " << exposure;
    }
    EXPECT_GT(largest_difference(stored(gamma, vignette(), 0.4), stored(gamma, {}, 1.0)), 0.1);
  }
}

TEST(Photometric, LeavesSaturatedAndBlackAndDoesNotExceedWhite) {
  cv::Mat1f half(1, 4, 0.5F);
  half(0, 0) = 1.0F;
  half(0, 3) = 0.0F;
  ColorImage image(1, 4, cv::Vec3f(0.3F, 0.8F, 1.0F));
  image(0, 2) = cv::Vec3f(0.0F, 0.499F, 254.4F / 255.0F);
  const ColorImage corrected = PhotometricCorrection(1.0, half).apply(image, 1.0);
  EXPECT_EQ(corrected(0, 0), image(0, 0));
  EXPECT_EQ(corrected(0, 1), cv::Vec3f(0.6F, 1.0F, 1.0F));
  EXPECT_EQ(corrected(0, 2), cv::Vec3f(0.0F, 0.998F, 1.0F));
  EXPECT_EQ(corrected(0, 3), cv::Vec3f(0.0F, 0.0F, 0.0F));  // no light reaches this pixel
  // With a longer exposure, saturated values stay white.
  EXPECT_EQ(PhotometricCorrection().apply(image, 2.0)(0, 1), cv::Vec3f(0.15F, 0.4F, 1.0F));
}

TEST(Photometric, WithoutCalibrationNoPixelChanges) {
  const TempFolder temp;
  put_darkened(temp, 2.2, false);
  std::filesystem::remove(temp / "exposures.txt");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.has_exposures());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_TRUE(same_pixels(s.color(i), read_color(s.color_file(i))));
    EXPECT_EQ(s.exposure(i), 1.0);
  }
}

TEST(Photometric, SequencesHandOutCorrectedColoursAndGrey) {
  for (const bool vignetted : {false, true}) {
    const TempFolder temp;
    put_darkened(temp, 2.2, vignetted);
    const Sequence s = Sequence::open(temp.path());
    ASSERT_TRUE(s.has_exposures());
    EXPECT_EQ(s.exposure(1), 0.5);
    EXPECT_THROW(s.exposure(3), std::out_of_range);
    const ColorImage expected = stored(2.2, {}, 1.0);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_LT(largest_difference(s.color(i), expected), 1.5 / 255.0) << i;
      EXPECT_LT(cv::norm(s.gray(i), to_gray(expected), cv::NORM_INF), 1.5 / 255.0) << i;
    }
    EXPECT_GT(largest_difference(read_color(s.color_file(1)), expected), 20.0 / 255.0);
  }
}

TEST(Photometric, EightBitVignettesCountAsWell) {
  const TempFolder temp;
  write_gray(temp / "v.png", cv::Mat1f(2, 3, 0.5F));
  EXPECT_EQ(read_vignette(temp / "v.png")(1, 2), 1.0F);
  cv::Mat1f levels(1, 2, 1.0F);
  levels(0, 1) = 0.4F;
  write_gray(temp / "w.png", levels);
  EXPECT_NEAR(read_vignette(temp / "w.png")(0, 1), 0.4F, 1e-6F);
}

TEST(Photometric, MovedSequencesKeepTheirCalibration) {
  const TempFolder temp;
  put_darkened(temp, 2.2, true);
  const Sequence s = Sequence::open(temp.path());
  write_moved_sequence(temp / "moved", s, Similarity());
  const Sequence moved = Sequence::open(temp / "moved");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_LT(largest_difference(moved.color(i), s.color(i)), 1e-5) << i;
  // A later run without exposures removes the file.
  std::filesystem::remove(temp / "exposures.txt");
  write_moved_sequence(temp / "moved", Sequence::open(temp.path()), Similarity());
  EXPECT_FALSE(std::filesystem::exists(temp / "moved/exposures.txt"));
}

TEST(Photometric, BadVignettesAreRefused) {
  const TempFolder temp;
  put_darkened(temp, 1.0, true);
  const auto fault = [&] { return error_of([&] { Sequence::open(temp.path()); }); };
  write_png16(temp / "vignette.png", cv::Mat1w(20, 30, std::uint16_t{9}));
  EXPECT_EQ(fault(), temp / "vignette.png" + ": is 30x20, " + temp / "camera.yaml" + " is for 40x30");
  write_png16(temp / "vignette.png", cv::Mat1w(height, width, std::uint16_t{0}));
  EXPECT_THAT(fault(), HasSubstr("vignette.png: is black"));
  temp.put("vignette.png", "no image");
  EXPECT_THAT(fault(), StartsWith(temp / "vignette.png"));
  std::filesystem::remove(temp / "vignette.png");
  EXPECT_THAT(fault(), HasSubstr("vignette.png"));
  EXPECT_THAT(error_of([] { PhotometricCorrection(0.0, {}); }), HasSubstr("gamma"));
  EXPECT_THAT(error_of([] { PhotometricCorrection(1.0, cv::Mat1f(1, 1, 1.5F)); }), HasSubstr("vignette"));
  EXPECT_THAT(error_of([] { PhotometricCorrection(1.0, cv::Mat1f(1, 1, 0.5F)).apply(ColorImage(2, 2), 1.0); }),
              HasSubstr("1x1"));
  EXPECT_THAT(error_of([] { PhotometricCorrection().apply(ColorImage(2, 2), 0.0); }), HasSubstr("exposure"));
}

TEST(Photometric, ExposuresAreFoundByTimeAndDividedByTheirMedian) {
  EXPECT_THAT(parse_exposures("e", "# time exposure\n0.5 7\n1.0 2\n\n2.004\t4e0\n2.9999 +8\n", {1.0, 2.0, 3.0}),
              ElementsAre(0.5, 1.0, 2.0));
  const auto fault = [](const std::string& text) { return error_of([&] { parse_exposures("e", text, {1.0, 2.0}); }); };
  EXPECT_EQ(fault("1 2\n2.02 2\n"), "e: has no exposure for frame 1");
  EXPECT_EQ(fault("1 2\n2 0\n"), "e: line 2: the exposure is not positive");
  EXPECT_EQ(fault("1 2\n2 -3\n"), "e: line 2: the exposure is not positive");
  EXPECT_EQ(fault("2 2\n1 2\n"), "e: line 2: times must grow");
  EXPECT_EQ(fault("1 2 3\n"), "e: line 1: is not `time exposure`");
  EXPECT_EQ(fault("1 long\n"), "e: line 1: `long` is not a number");
  EXPECT_EQ(fault("1 nan\n"), "e: line 1: `nan` is not a number");
  EXPECT_EQ(fault(""), "e: has no exposure for frame 0");
}

TEST(Photometric, TimesOfDsoGoInOrder) {
  EXPECT_THAT(parse_dso_times("t", "00000 1400000.1 10\n00001 1400000.2 20\n00002 1400000.3 5\n", 3),
              ElementsAre(1.0, 2.0, 0.5));
  EXPECT_THAT(parse_dso_times("t", "image_a 1.0 3\n", 1), ElementsAre(1.0));
  // Files of times with other formats.
  for (const char* text : {"", "0.1\n0.2\n", "0 0.1\n1 0.2\n", "1 2 3 4\n", "1.0 rgb/1.png more\n"}) {
    EXPECT_TRUE(parse_dso_times("t", text, 2).empty()) << text;
  }
  const auto fault = [](const std::string& text) { return error_of([&] { parse_dso_times("t", text, 2); }); };
  EXPECT_EQ(fault("0 1 2\n"), "t: lists 1 exposures, the sequence has 2 frames");
  EXPECT_EQ(fault("0 1 2\n1 2\n"), "t: line 2: is not `id time exposure`");
  EXPECT_EQ(fault("0 1 2\n1 2 0\n"), "t: line 2: the exposure is not positive");
  EXPECT_EQ(fault("0 1 2\n1 2 x\n"), "t: line 2: `x` is not a number");
}

TEST(Photometric, ExposuresComeFromTheSequencesFolder) {
  const TempFolder temp;
  EXPECT_TRUE(read_exposures(temp.path(), {1.0}).empty());
  temp.put("times.txt", "0 1.0 3\n1 2.0 3\n2 3.0 6\n");
  EXPECT_THAT(read_exposures(temp.path(), {1.0, 2.0, 3.0}), ElementsAre(1.0, 1.0, 2.0));
  temp.put("exposures.txt", "1 6\n2 3\n3 3\n");
  EXPECT_THAT(read_exposures(temp.path(), {1.0, 2.0, 3.0}), ElementsAre(2.0, 1.0, 1.0));
}

}  // namespace
}  // namespace odosplat
