// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>

namespace odosplat {

/// What the containers of PNG and JPEG say, without decoding.
struct ImageContainer {
  bool is_png = false;
  int width = 0;
  int height = 0;
  int bits = 0;          // a channel
  bool is_gray = false;  // one channel, no palette
};

/// Walks a PNG chunk by chunk (ISO/IEC 15948; checksums compared) or a JPEG marker by marker (ITU T.81) to its end.
/// Throws InputError naming the file: neither of both, ends too early, a checksum is wrong, size beyond 32768, two
/// frame headers or over 500 scans in a JPEG.
ImageContainer inspect_image(const std::string& name, const std::string& bytes);

/// A PNG with the chunks that pixels need and no others: colour profiles and the like make libpng print warnings and
/// have no say here. bytes must have passed inspect_image.
std::string bare_png(const std::string& bytes);

}  // namespace odosplat
