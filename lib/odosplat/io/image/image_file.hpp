// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstdint>
#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Limits for the size of an image. They are checked against the file's header before anything is decoded, because a
/// file of a few kilobytes may declare a size that takes gigabytes.
struct ImageLimit {
  static constexpr std::int64_t default_max_pixels = 100'000'000;
  /// OpenCV's own limit: it does not decode larger images.
  static constexpr std::int64_t most_pixels = std::int64_t{1} << 30;

  std::int64_t max_pixels = default_max_pixels;
  std::function<void(const cv::Size&)> require_size;  // throws for a size that is not wanted; empty: any size

  /// Throws InputError naming the file if it is too large, or what require_size throws.
  void check(const std::string& name, const cv::Size& size) const;
  /// Largest size of a file with such an image [bytes]: 16 bits per channel, uncompressed, and room for the metadata of
  /// cameras and editors.
  std::uint64_t max_bytes() const;
};

/// Image files: PNG and JPEG, recognised by their content; every other format is refused. Pixels are returned as
/// stored: no gamma, no colour profile, no rotation by EXIF. Reading throws InputError naming the file: missing, not a
/// regular file, neither PNG nor JPEG, larger than the limit, damaged. Size, end of file and checksums of PNG chunks
/// are checked before decoding, because decoders accept any declared size and return truncated images partly grey.
/// Thread safe.

/// RGB 0..1; grey files give three equal channels, 16-bit files are reduced to 8 bits, alpha is dropped.
ColorImage read_color(const std::string& path, const ImageLimit& limit = {});
/// Luma 0..1 of read_color.
GrayImage read_gray(const std::string& path, const ImageLimit& limit = {});
/// Values of a 16-bit grey PNG. InputError for any other image.
cv::Mat1w read_depth_raw(const std::string& path, const ImageLimit& limit = {});
/// read_color and read_depth_raw from memory; `name` stands for the file in errors.
ColorImage parse_color(const std::string& name, const std::string& bytes, const ImageLimit& limit = {});
cv::Mat1w parse_depth_raw(const std::string& name, const std::string& bytes, const ImageLimit& limit = {});
/// Width and height, after the same checks, without decoding.
cv::Size read_image_size(const std::string& path, const ImageLimit& limit = {});

/// Write PNG files through AtomicFile. Values are rounded and clamped; NaN counts as 0. Throw InputError if the path
/// cannot be written or the image is empty.
void write_color(const std::string& path, const ColorImage& color);  // 8-bit RGB
void write_rgb8(const std::string& path, const cv::Mat3b& rgb);      // channel order R, G, B
void write_gray(const std::string& path, const GrayImage& gray);     // 8-bit grey
void write_png16(const std::string& path, const cv::Mat1w& image);   // 16-bit grey
/// 16-bit grey: metres * units_per_metre. Values out of range become 0 (no depth), so that no wrong depth is stored.
/// Returns how many pixels were too far for it (largest_depth).
std::size_t write_depth(const std::string& path, const DepthImage& depth, double units_per_metre);
/// [m] The largest depth that write_depth stores.
double largest_depth(double units_per_metre);

}  // namespace odosplat
