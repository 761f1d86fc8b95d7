// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "odosplat/core/image.hpp"

namespace odosplat {

/// Image files: PNG and JPEG, told by their content. Pixels are handed out as stored: no gamma, no colour profile, no
/// rotation by EXIF. Reading throws InputError naming the file: missing, neither PNG nor JPEG, damaged. The end of the
/// file and the checksums of PNG chunks are checked before decoding, since decoders return truncated images half grey.
/// Thread safe.

/// RGB 0..1; grey files give three equal channels, 16-bit files are reduced to 8 bits, alpha is dropped.
ColorImage read_color(const std::string& path);
/// Luma 0..1 of read_color.
GrayImage read_gray(const std::string& path);
/// Values of a 16-bit grey PNG. InputError if it is not one.
cv::Mat1w read_depth_raw(const std::string& path);
/// The same three from memory; `name` stands for the file in errors.
ColorImage parse_color(const std::string& name, const std::string& bytes);
cv::Mat1w parse_depth_raw(const std::string& name, const std::string& bytes);
/// Width and height, after the same checks, without decoding.
cv::Size read_image_size(const std::string& path);

/// PNG files, written beside and renamed. Values are rounded and clamped; NaN counts as 0. InputError if the path
/// cannot be written; an empty image is refused likewise.
void write_color(const std::string& path, const ColorImage& color);  // 8-bit RGB
void write_rgb8(const std::string& path, const cv::Mat3b& rgb);      // channel order R, G, B
void write_gray(const std::string& path, const GrayImage& gray);     // 8-bit grey
void write_png16(const std::string& path, const cv::Mat1w& image);   // 16-bit grey
/// 16-bit grey: metres * units_per_metre; 0 stays 0, what is beyond the range becomes 0 (no value), not a wrong one.
void write_depth(const std::string& path, const DepthImage& depth, double units_per_metre);

}  // namespace odosplat
