// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Text drawn by VTK's FreeType with VTK's built-in sans-serif font, so that figures look the same on every machine.
/// The font contains only ASCII: every other character is drawn as '?'. One line; any thread (calls are serialised,
/// because VTK's font cache is shared by the process).

/// Coverage (0..255) of a line of text: as wide as the text, as high as a line of that size [px]. size < 4 is drawn as
/// 4. Empty text gives an empty matrix.
cv::Mat1b text_ink(const std::string& text, int size);

/// Width of the line [px]; 0 for empty text.
int text_width(const std::string& text, int size);

/// Text that fits into max_width [px]: at `size` if possible, otherwise smaller (not below `least` times size),
/// otherwise cut with "..." at its end.
struct FittedText {
  std::string text;
  int size = 0;
};
FittedText fit_text(const std::string& text, int size, double max_width, double least = 0.7);

}  // namespace odosplat
