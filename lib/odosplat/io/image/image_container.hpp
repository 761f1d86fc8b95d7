// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// Properties of a PNG or JPEG image, read from its container without decoding.
struct ImageContainer {
  bool is_png = false;
  int width = 0;
  int height = 0;
  int bits = 0;          // per channel
  bool is_gray = false;  // one channel, no palette
};

/// Reads a PNG chunk by chunk (ISO/IEC 15948; checksums are verified) or a JPEG marker by marker (ITU T.81) to its end.
/// Throws InputError naming the file: neither PNG nor JPEG, truncated, a wrong checksum, a side of more than 32768
/// pixels, two frame headers or over 500 scans in a JPEG.
ImageContainer inspect_image(const std::string& name, const std::string& bytes);

/// A PNG reduced to the chunks that are needed to decode its pixels: colour profiles and other chunks are not used, and
/// libpng prints warnings for some of them. bytes must have passed inspect_image.
std::string bare_png(const std::string& bytes);

}  // namespace odosplat
