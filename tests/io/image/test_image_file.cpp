// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/image/image_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/core/random.hpp"
#include "tests/io/image/image_bytes.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::encoded;
using test::error_of;
using test::TempFolder;
using testing::AnyOf;
using testing::ElementsAre;
using testing::HasSubstr;

cv::Mat3b noise_image(int width, int height) {
  Random random(5);
  cv::Mat3b image(height, width);
  for (cv::Vec3b& pixel : image) {
    for (int c = 0; c < 3; ++c) pixel[c] = static_cast<unsigned char>(random.below(256));
  }
  return image;
}

TEST(ImageFile, ColourRoundTrip) {
  const TempFolder temp;
  ColorImage image(7, 13);
  for (int y = 0; y < image.rows; ++y) {
    for (int x = 0; x < image.cols; ++x) {
      image(y, x) = {static_cast<float>(x * 20) / 255.0F, static_cast<float>(y * 30) / 255.0F, 1.0F};
    }
  }
  write_color(temp / "a/b.png", image);
  const ColorImage read = read_color(temp / "a/b.png");
  EXPECT_LT(cv::norm(read, image, cv::NORM_INF), 1e-6);
  const GrayImage gray = read_gray(temp / "a/b.png");
  EXPECT_NEAR(gray(2, 3), 0.299F * 60.0F / 255.0F + 0.587F * 60.0F / 255.0F + 0.114F, 1e-6F);
  EXPECT_EQ(read_image_size(temp / "a/b.png"), cv::Size(13, 7));
}

TEST(ImageFile, ChannelsAreInTheOrderRedGreenBlue) {
  const TempFolder temp;
  write_rgb8(temp / "red.png", cv::Mat3b(2, 2, cv::Vec3b(255, 0, 0)));
  EXPECT_EQ(read_color(temp / "red.png")(0, 0), cv::Vec3f(1.0F, 0.0F, 0.0F));
  EXPECT_EQ(cv::imread(temp / "red.png").at<cv::Vec3b>(0, 0), cv::Vec3b(0, 0, 255));  // OpenCV: blue first
  const std::string jpeg = temp.put_image("blue.jpg", cv::Mat3b(16, 16, cv::Vec3b(255, 0, 0)));
  EXPECT_GT(read_color(jpeg)(8, 8)[2], 0.95F);
}

TEST(ImageFile, GreyFilesGiveEqualChannels) {
  const TempFolder temp;
  GrayImage gray(3, 4, 0.4F);
  gray(1, 2) = 1.0F;
  write_gray(temp / "g.png", gray);
  EXPECT_EQ(cv::imread(temp / "g.png", cv::IMREAD_UNCHANGED).type(), CV_8UC1);
  const ColorImage read = read_color(temp / "g.png");
  for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(read(0, 0)[c], 102.0F / 255.0F);
  EXPECT_EQ(read(1, 2), cv::Vec3f::all(1.0F));
}

TEST(ImageFile, ValuesAreClampedAndNotANumberIsBlack) {
  const TempFolder temp;
  GrayImage gray(1, 4);
  gray(0, 0) = -3.0F;
  gray(0, 1) = 7.0F;
  gray(0, 2) = std::numeric_limits<float>::quiet_NaN();
  gray(0, 3) = 0.5F;
  write_gray(temp / "g.png", gray);
  const cv::Mat1b bytes = cv::imread(temp / "g.png", cv::IMREAD_UNCHANGED);
  EXPECT_THAT(std::vector<int>(bytes.begin(), bytes.end()), ElementsAre(0, 255, 0, 128));
}

TEST(ImageFile, DepthKeepsSixteenBits) {
  const TempFolder temp;
  cv::Mat1w raw(5, 6);
  for (int i = 0; i < 30; ++i) raw(i / 6, i % 6) = static_cast<std::uint16_t>(i * 2000 + 1);
  write_png16(temp / "d.png", raw);
  EXPECT_EQ(cv::norm(read_depth_raw(temp / "d.png"), raw, cv::NORM_INF), 0.0);
  DepthImage depth(1, 5);
  depth(0, 0) = 1.2344F;
  depth(0, 1) = 0.0F;
  depth(0, 2) = 70.0F;  // beyond 16 bits
  depth(0, 3) = -1.0F;
  depth(0, 4) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(write_depth(temp / "m.png", depth, 1000.0), 1U);
  const cv::Mat1w units = read_depth_raw(temp / "m.png");
  EXPECT_THAT(std::vector<int>(units.begin(), units.end()), ElementsAre(1234, 0, 0, 0, 0));
}

TEST(ImageFile, DepthMustBeSixteenBitGrey) {
  const TempFolder temp;
  for (const std::string& file :
       {temp.put_image("8.png", cv::Mat1b(4, 4, std::uint8_t{1})), temp.put_image("c.png", noise_image(4, 4)),
        temp.put_image("c16.png", cv::Mat3w(4, 4, cv::Vec3w(1, 2, 3))), temp.put_image("j.jpg", noise_image(4, 4))}) {
    EXPECT_EQ(error_of([&] { read_depth_raw(file); }), file + ": is not a 16-bit grey PNG");
  }
}

// OpenCV decodes truncated files to images that are grey or black below some row.
TEST(ImageFile, TruncatedPngIsAnErrorAtEveryLength) {
  const std::string bytes = encoded(".png", noise_image(20, 15));
  ASSERT_EQ(parse_color("i.png", bytes).size(), cv::Size(20, 15));
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_EQ(error_of([&] { parse_color("i.png", bytes.substr(0, length)); }),
              length == 0 ? "i.png: is empty" : "i.png: is truncated")
        << length;
  }
}

TEST(ImageFile, TruncatedJpegIsAnErrorAtEveryLength) {
  for (const bool progressive : {false, true}) {
    const std::string bytes = encoded(".jpg", noise_image(40, 24),
                                      {cv::IMWRITE_JPEG_PROGRESSIVE, progressive, cv::IMWRITE_JPEG_RST_INTERVAL, 2});
    ASSERT_EQ(parse_color("i.jpg", bytes).size(), cv::Size(40, 24));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      EXPECT_THAT(error_of([&] { parse_color("i.jpg", bytes.substr(0, length)); }), testing::StartsWith("i.jpg: is "))
          << length;
    }
    // Zeros at the end, as after an interrupted download.
    std::string padded = bytes;
    std::fill(padded.begin() + static_cast<std::ptrdiff_t>(padded.size() / 2), padded.end(), '\0');
    EXPECT_THROW(parse_color("i.jpg", padded), InputError);
  }
}

TEST(ImageFile, TruncatedDepthIsAnErrorAtEveryLength) {
  cv::Mat1w raw(30, 40);
  cv::randu(raw, 0, 65535);
  const std::string bytes = encoded(".png", raw);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_THROW(parse_depth_raw("d.png", bytes.substr(0, length)), InputError) << length;
  }
}

TEST(ImageFile, AChangedByteOfAPngIsFound) {
  const std::string bytes = encoded(".png", noise_image(20, 15));
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_THROW(parse_color("i.png", changed), InputError) << at;
  }
}

TEST(ImageFile, SharedImagesTruncatedAreErrors) {
  for (const char* name : {"icl_office_kt3/rgb/0001.jpg", "tum_fr1_rpy_short/rgb/1305031249.529692.png"}) {
    SHARED_DATA_OR_SKIP(path, name);
    const std::string bytes = read_file(path);
    EXPECT_FALSE(parse_color("i", bytes).empty());
    for (int k = 0; k < 200; ++k) {
      EXPECT_THROW(parse_color("i", bytes.substr(0, bytes.size() * static_cast<std::size_t>(k) / 200)), InputError);
    }
    EXPECT_THROW(parse_color("i", bytes.substr(0, bytes.size() - 1)), InputError);
  }
}

TEST(ImageFile, OtherContentIsNamed) {
  const TempFolder temp;
  EXPECT_EQ(error_of([&] { read_color(temp.put("t.png", "just text")); }),
            temp / "t.png" + ": is neither PNG nor JPEG");
  EXPECT_EQ(error_of([&] { read_color(temp.put("b.png", encoded(".bmp", noise_image(3, 3)))); }),
            temp / "b.png" + ": is neither PNG nor JPEG");
  EXPECT_EQ(error_of([&] { read_color(temp / "none.png"); }), temp / "none.png" + ": is missing");
  // The format is recognised by the content, not by the name.
  EXPECT_EQ(read_color(temp.put("j.png", encoded(".jpg", noise_image(9, 8)))).size(), cv::Size(9, 8));
}

std::string png_chunk(const std::string& type, const std::string& data) {
  std::uint32_t crc = 0xFFFFFFFFU;
  for (const char c : type + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int k = 0; k < 8; ++k) crc = (crc >> 1U) ^ ((crc & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  const auto word = [](std::uint32_t v) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(v >> static_cast<unsigned>(shift));
    return bytes;
  };
  return word(static_cast<std::uint32_t>(data.size())) + type + data + word(crc ^ 0xFFFFFFFFU);
}

TEST(ImageFile, DecodersSayNothingThemselves) {
  const std::string bytes = encoded(".png", noise_image(8, 8));
  testing::internal::CaptureStderr();
  // An invalid colour profile, about which libpng would print a warning.
  std::string with_profile = bytes;
  with_profile.insert(33, png_chunk("iCCP", std::string("rubbish\0\0no profile", 19)));
  EXPECT_EQ(parse_color("i", with_profile).size(), cv::Size(8, 8));
  for (std::size_t length = 1; length < bytes.size(); length += 7) {
    EXPECT_THROW(parse_color("i", bytes.substr(0, length)), InputError);
  }
  EXPECT_THROW(read_color("/nowhere.png"), InputError);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageFile, UnwritablePlacesAndEmptyImagesLeaveNothing) {
  const TempFolder temp;
  const std::string file = temp.put("file", "");
  EXPECT_THAT(error_of([&] { write_gray(file + "/x.png", GrayImage(2, 2, 0.0F)); }),
              HasSubstr("/x.png: cannot be written"));
  EXPECT_THAT(error_of([&] { write_color(temp / "e.png", ColorImage()); }), HasSubstr("the image is empty"));
  EXPECT_THAT(error_of([&] { write_png16(temp / "e.png", cv::Mat1w()); }), HasSubstr("the image is empty"));
  EXPECT_THAT(temp.files(), ElementsAre("file"));
}

// The pixels do not match the size in the header: decoding them would report "is damaged".
TEST(ImageFile, SizesAreJudgedByTheHeaderAlone) {
  const std::string png = encoded(".png", noise_image(20, 15));
  const std::string depth = encoded(".png", cv::Mat1w(15, 20, std::uint16_t{7}));
  const std::string jpeg = encoded(".jpg", noise_image(20, 15));
  const std::string over = " over the limit of 100000000 pixels (--max-image-pixels)";
  EXPECT_EQ(error_of([&] { parse_color("i.png", test::png_claiming(png, 32768, 32768)); }),
            "i.png: is 32768x32768," + over);
  EXPECT_EQ(error_of([&] { parse_color("i.jpg", test::jpeg_claiming(jpeg, 32000, 32000)); }),
            "i.jpg: is 32000x32000," + over);
  EXPECT_EQ(error_of([&] { parse_depth_raw("d.png", test::png_claiming(depth, 32768, 4000)); }),
            "d.png: is 32768x4000," + over);
  EXPECT_EQ(error_of([&] {
              parse_color("i.png", test::png_claiming(png, 20, 16), {319, {}});
            }),
            "i.png: is 20x16, over the limit of 319 pixels (--max-image-pixels)");
  EXPECT_EQ(error_of([&] { parse_color("i.png", test::png_claiming(png, 20, 16), {320, {}}); }), "i.png: is damaged");
  EXPECT_EQ(parse_color("i.png", png, {300, {}}).size(), cv::Size(20, 15));

  const ImageLimit none{1000, [](const cv::Size&) { throw InputError("not this size"); }};
  EXPECT_EQ(error_of([&] { parse_color("i.png", test::png_claiming(png, 30, 30), none); }), "not this size");
  EXPECT_EQ(error_of([&] { parse_depth_raw("d.png", test::png_claiming(depth, 30, 30), none); }), "not this size");
  const TempFolder temp;
  EXPECT_EQ(error_of([&] {
              read_image_size(temp.put("i.png", png), {299, {}});
            }),
            temp / "i.png" + ": is 20x15, over the limit of 299 pixels (--max-image-pixels)");
}

TEST(ImageFile, AJpegHasOneHeaderAndFewScans) {
  const std::string jpeg = encoded(".jpg", noise_image(20, 15));
  const std::size_t header = jpeg.find("\xff\xc0");
  const std::size_t length = 2U + static_cast<unsigned char>(jpeg[header + 3]);
  const std::string second = jpeg.substr(header, length);
  EXPECT_EQ(error_of([&] { parse_color("i.jpg", std::string(jpeg).insert(header, second)); }), "i.jpg: is damaged");
  const std::size_t scan = jpeg.find("\xff\xda");
  const std::string end = "\xff\xd9";
  std::string many = jpeg.substr(0, jpeg.size() - 2);
  for (int k = 0; k < 500; ++k) many += jpeg.substr(scan, jpeg.size() - 2 - scan);
  EXPECT_EQ(error_of([&] { parse_color("i.jpg", many + end); }),
            "i.jpg: has more scans than any camera or editor writes");
  EXPECT_EQ(error_of([&] { parse_color("i.jpg", jpeg.substr(0, jpeg.size() - 2) + second + end); }),
            "i.jpg: is damaged");
}

TEST(ImageFile, AFileLargerThanItsPixelsCanBeIsNotReadIntoMemory) {
  const TempFolder temp;
  const std::string file = temp.put("i.png", encoded(".png", noise_image(3, 3)));
  std::filesystem::resize_file(file, std::uintmax_t{65} << 20U);  // a sparse file: uses no space on the disk
  EXPECT_EQ(error_of([&] {
              read_color(file, {9, {}});
            }),
            file + ": is larger than the 64 MB that such a file may have");
}

}  // namespace
}  // namespace odosplat
