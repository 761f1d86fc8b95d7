// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// What an image may be. Asked of its header before anything is decoded: a file of a few kilobytes may claim a size
/// that takes gigabytes.
struct ImageLimit {
  static constexpr std::int64_t default_max_pixels = 100'000'000;
  /// The codecs' own limits: OpenCV decodes no more at once.
  static constexpr std::int64_t most_pixels = std::int64_t{1} << 30;

  std::int64_t max_pixels = default_max_pixels;
  std::function<void(const cv::Size&)> require_size;  // throws for a size that is not wanted; empty: any will do

  /// InputError naming the file if it is too large, or what require_size throws.
  void check(const std::string& name, const cv::Size& size) const;
  /// The most bytes that a file of such images may have: 16 bits a channel, uncompressed, and room for what cameras and
  /// editors put beside the pixels.
  std::uint64_t max_bytes() const;
};

/// Image files: PNG and JPEG, told by their content; every other format is refused. Pixels are handed out as stored: no
/// gamma, no colour profile, no rotation by EXIF. Reading throws InputError naming the file: missing, not a regular
/// file, neither PNG nor JPEG, beyond the limit, damaged. Size, the end of the file and the checksums of PNG chunks are
/// checked before decoding, since decoders believe any size and return truncated images half grey. Thread safe.

/// RGB 0..1; grey files give three equal channels, 16-bit files are reduced to 8 bits, alpha is dropped.
ColorImage read_color(const std::string& path, const ImageLimit& limit = {});
/// Luma 0..1 of read_color.
GrayImage read_gray(const std::string& path, const ImageLimit& limit = {});
/// Values of a 16-bit grey PNG. InputError if it is not one.
cv::Mat1w read_depth_raw(const std::string& path, const ImageLimit& limit = {});
/// The same three from memory; `name` stands for the file in errors.
ColorImage parse_color(const std::string& name, const std::string& bytes, const ImageLimit& limit = {});
cv::Mat1w parse_depth_raw(const std::string& name, const std::string& bytes, const ImageLimit& limit = {});
/// Width and height, after the same checks, without decoding.
cv::Size read_image_size(const std::string& path, const ImageLimit& limit = {});

/// PNG files, written beside and renamed. Values are rounded and clamped; NaN counts as 0. InputError if the path
/// cannot be written; an empty image is refused likewise.
void write_color(const std::string& path, const ColorImage& color);  // 8-bit RGB
void write_rgb8(const std::string& path, const cv::Mat3b& rgb);      // channel order R, G, B
void write_gray(const std::string& path, const GrayImage& gray);     // 8-bit grey
void write_png16(const std::string& path, const cv::Mat1w& image);   // 16-bit grey
/// 16-bit grey: metres * units_per_metre; 0 stays 0, what is beyond the range becomes 0 (no value), not a wrong one.
void write_depth(const std::string& path, const DepthImage& depth, double units_per_metre);

}  // namespace odosplat
