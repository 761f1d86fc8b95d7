// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Pictures for people, in the format that the name ends in, in any case:
///   .png; .jpg or .jpeg (quality 95);
///   .pdf: one page of the picture's size at 96 pixels per inch, the pixels without loss;
///   .svg: the same, the picture embedded as PNG.
/// Both of the latter hold pixels, not lines.

/// InputError with the endings that can be written if the name has another; to be called before work is done.
void check_picture_name(const std::string& path);

/// channel order R, G, B. Written beside and renamed. InputError as above, for an empty picture, and if the path cannot
/// be written.
void write_picture(const std::string& path, const cv::Mat3b& rgb);

}  // namespace odosplat
