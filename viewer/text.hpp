// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

namespace odosplat {

/// Text drawn by VTK's FreeType with the sans-serif font that is part of VTK, so that figures look the same wherever
/// they are made. That font holds ASCII only: every other character is drawn as '?'. One line; any thread (calls are
/// serialised, VTK's font cache is one for the process).

/// Ink of a line of text, 0..255: as wide as the text, as high as a line of that size [px]. size < 4 is drawn as 4.
/// Empty text gives an empty matrix.
cv::Mat1b text_ink(const std::string& text, int size);

/// Width of the line [px]; 0 for empty text.
int text_width(const std::string& text, int size);

/// Text as it fits into max_width [px]: at `size` if it can be, else smaller (not below `least` of it), else cut with
/// "..." at its end.
struct FittedText {
  std::string text;
  int size = 0;
};
FittedText fit_text(const std::string& text, int size, double max_width, double least = 0.7);

}  // namespace odosplat
