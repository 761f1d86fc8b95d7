// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Pictures for reports and figures. The format follows from the name's extension, in upper or lower case:
///   .png; .jpg or .jpeg (quality 95);
///   .pdf: one page of the picture's size at 96 pixels per inch, the pixels without loss;
///   .svg: the same, the picture embedded as PNG.
/// PDF and SVG contain pixels, not vector graphics.

/// Throws InputError, listing the supported extensions, if the name has another one. To be called before any work.
void check_picture_name(const std::string& path);

/// Channel order R, G, B. Written through AtomicFile. Throws InputError as above, for an empty picture, and if the path
/// cannot be written.
void write_picture(const std::string& path, const cv::Mat3b& rgb);

/// The bytes of a JPEG file of the picture (R, G, B), for files that contain pictures. quality: 1..100.
std::string jpeg_bytes(const cv::Mat3b& rgb, int quality);

}  // namespace odosplat
