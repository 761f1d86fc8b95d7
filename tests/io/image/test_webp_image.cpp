// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/image/webp_image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

std::string encoded(const cv::Mat& image, int quality) {
  std::vector<unsigned char> bytes;
  cv::imencode(".webp", image, bytes, {cv::IMWRITE_WEBP_QUALITY, quality});
  return {bytes.begin(), bytes.end()};
}

std::string fault(const std::string& bytes, std::int64_t max_pixels = 1'000'000) {
  try {
    parse_lossless_webp("m.webp", bytes, max_pixels);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(WebpImage, ValuesAreExact) {
  cv::RNG random(3);
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(41, 37), cv::Size(300, 2)}) {
    cv::Mat4b rgba(size);
    random.fill(rgba, cv::RNG::UNIFORM, 1, 256);  // encoders may change colours where alpha is 0
    cv::Mat bgra;
    cv::cvtColor(rgba, bgra, cv::COLOR_RGBA2BGRA);
    EXPECT_EQ(cv::norm(parse_lossless_webp("m.webp", encoded(bgra, 101), 1'000'000), rgba, cv::NORM_INF), 0.0);
    cv::Mat bgr;
    cv::cvtColor(rgba, bgr, cv::COLOR_RGBA2BGR);
    for (cv::Vec4b& pixel : rgba) pixel[3] = 255;
    EXPECT_EQ(cv::norm(parse_lossless_webp("m.webp", encoded(bgr, 101), 1'000'000), rgba, cv::NORM_INF), 0.0);
  }
}

TEST(WebpImage, ImagesOfOneColorAreRead) {
  const cv::Mat4b gray(64, 64, cv::Vec4b(7, 7, 7, 255));
  EXPECT_EQ(cv::norm(parse_lossless_webp("m.webp", encoded(gray, 101), 4096), gray, cv::NORM_INF), 0.0);
}

TEST(WebpImage, FaultsAreNamed) {
  cv::Mat image(20, 30, CV_8UC4);
  cv::RNG(5).fill(image, cv::RNG::UNIFORM, 1, 256);
  const std::string good = encoded(image, 101);
  EXPECT_EQ(fault(good), "");
  EXPECT_EQ(fault(good, 599), "m.webp: is 30x20, must have at most 599 pixels");
  EXPECT_THAT(fault(encoded(image, 50)), HasSubstr("m.webp: is a lossy WebP image, must be lossless"));
  EXPECT_EQ(fault("RIFF1234WEBQ"), "m.webp: is no WebP image");
  testing::internal::CaptureStderr();
  for (std::size_t n = 0; n + 1 < good.size(); n += 5) EXPECT_NE(fault(good.substr(0, n)), "") << n;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");  // OpenCV's own words
}

}  // namespace
}  // namespace odosplat
