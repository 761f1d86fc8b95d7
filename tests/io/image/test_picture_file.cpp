// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "odosplat/core/error.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/image/image_file.hpp"
#include "odosplat/io/image/picture_file.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

class PictureFile : public testing::Test {
 protected:
  void SetUp() override {
    for (int y = 0; y < picture_.rows; ++y) {
      for (int x = 0; x < picture_.cols; ++x) {
        picture_(y, x) = cv::Vec3b(static_cast<unsigned char>(5 * x), static_cast<unsigned char>(7 * y), 200);
      }
    }
  }
  std::string written(const std::string& name) {
    write_picture(folder_ / name, picture_);
    return read_file(folder_ / name);
  }

  test::TempFolder folder_;
  cv::Mat3b picture_ = cv::Mat3b(24, 37);
};

/// The number after a word of a file.
std::size_t number_behind(const std::string& text, const std::string& word) {
  const std::size_t at = text.find(word);
  EXPECT_NE(at, std::string::npos) << word;
  return at == std::string::npos ? 0 : std::stoul(text.substr(at + word.size()));
}

std::string big_endian(std::size_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8)
    bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xFFU);
  return bytes;
}

TEST_F(PictureFile, JpegBytesDependOnTheQuality) {
  const std::string fine = jpeg_bytes(picture_, 95);
  EXPECT_THAT(fine, StartsWith("\xff\xd8\xff"));
  EXPECT_LT(jpeg_bytes(picture_, 30).size(), fine.size());
  const ColorImage read = parse_color("memory", fine);
  ASSERT_EQ(read.size(), picture_.size());
  EXPECT_NEAR(read(12, 20)[0], picture_(12, 20)[0] / 255.0, 0.03) << "red is the first channel";
  EXPECT_NEAR(read(12, 20)[2], picture_(12, 20)[2] / 255.0, 0.03);
  EXPECT_THROW(jpeg_bytes(cv::Mat3b(), 95), InputError);
}

TEST_F(PictureFile, EndingsSayTheFormatInAnyCase) {
  EXPECT_THAT(written("a.png"), StartsWith("\x89PNG"));
  EXPECT_THAT(written("a.PNG"), StartsWith("\x89PNG"));
  EXPECT_THAT(written("a.jpg"), StartsWith("\xff\xd8\xff"));
  EXPECT_THAT(written("a.Jpeg"), StartsWith("\xff\xd8\xff"));
  EXPECT_THAT(written("a.pdf"), StartsWith("%PDF-1."));
  EXPECT_THAT(written("a.PDF"), StartsWith("%PDF-1."));
  EXPECT_THAT(written("a.svg"), StartsWith("<svg"));
}

TEST_F(PictureFile, OtherEndingsAreRefusedWithTheList) {
  for (const char* name : {"a.gif", "a", "a.mp4", "a.html", "a.eps", "png"}) {
    try {
      write_picture(folder_ / name, picture_);
      FAIL() << name;
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), HasSubstr(".png, .jpg, .jpeg, .pdf or .svg"));
    }
  }
  EXPECT_THROW(write_picture(folder_ / "a.pdf", cv::Mat3b()), InputError);
}

TEST_F(PictureFile, PngAndJpegHoldThePicture) {
  written("a.png");
  written("a.jpg");
  const ColorImage exact = read_color(folder_ / "a.png");
  const ColorImage near = read_color(folder_ / "a.jpg");
  ASSERT_EQ(exact.size(), picture_.size());
  for (int y = 0; y < picture_.rows; ++y) {
    for (int x = 0; x < picture_.cols; ++x) {
      for (int c = 0; c < 3; ++c) {
        EXPECT_FLOAT_EQ(255.0F * exact(y, x)[c], picture_(y, x)[c]);
        EXPECT_NEAR(255.0F * near(y, x)[c], picture_(y, x)[c], 12.0F);
      }
    }
  }
}

TEST_F(PictureFile, PdfHoldsThePixelsAndItsTableIsRight) {
  const std::string pdf = written("a.pdf");
  EXPECT_THAT(pdf, HasSubstr("/MediaBox [0 0 27.75 18.00]"));
  // The table of objects: each line is the position of an object.
  const std::size_t table = number_behind(pdf, "startxref\n");
  ASSERT_EQ(pdf.compare(table, 9, "xref\n0 6\n"), 0);
  for (std::size_t object = 1; object <= 5; ++object) {
    const std::size_t start = std::stoul(pdf.substr(table + 9 + 20 * object, 10));
    const std::string head = std::to_string(object) + " 0 obj\n";
    EXPECT_EQ(pdf.compare(start, head.size(), head), 0) << object;
  }
  // Its stream is that of a PNG: the same rows and predictors, as stated by the parameters.
  EXPECT_THAT(pdf, HasSubstr("/Predictor 15 /Colors 3 /BitsPerComponent 8 /Columns 37"));
  const std::size_t image = pdf.find("/Subtype /Image");
  ASSERT_NE(image, std::string::npos);
  const std::size_t size = number_behind(pdf.substr(image), "/Length ");
  const std::size_t start = pdf.find("stream\n", image) + 7;
  EXPECT_EQ(pdf.compare(start + size, 10, "\nendstream"), 0);
  const std::string png = written("b.png");
  const std::size_t rows = png.find("IDAT");
  EXPECT_EQ(png.substr(rows + 4, size), pdf.substr(start, size));
  EXPECT_EQ(png.substr(rows - 4, 4), big_endian(size));
}

TEST_F(PictureFile, SvgHoldsThePng) {
  const std::string svg = written("a.svg");
  EXPECT_THAT(svg, HasSubstr("width=\"37\" height=\"24\""));
  const std::string mark = "data:image/png;base64,";
  const std::size_t start = svg.find(mark) + mark.size();
  const std::string text = svg.substr(start, svg.find('"', start) - start);
  ASSERT_EQ(text.size() % 4, 0U);
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  for (std::size_t i = 0; i < text.size(); i += 4) {
    std::size_t group = 0;
    for (std::size_t k = 0; k < 4; ++k) group = group << 6U | (text[i + k] == '=' ? 0 : digits.find(text[i + k]));
    for (std::size_t k = 0; k < 3; ++k) bytes += static_cast<char>(group >> (16 - 8 * k) & 0xFFU);
  }
  for (auto padding = std::count(text.begin(), text.end(), '='); padding > 0; --padding) bytes.pop_back();
  EXPECT_EQ(bytes, written("a.png"));
}

}  // namespace
}  // namespace odosplat
