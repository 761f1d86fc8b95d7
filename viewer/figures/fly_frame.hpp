// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <string>

#include "odosplat/core/image.hpp"
#include "viewer/figures/depth_figure.hpp"

namespace odosplat {

/// A frame of a flight through a map: colour and depth side by side, below them a line of text and the depth scale.
struct FlyFrame {
  ColorImage color;  // 0..1; may be empty: only depth is shown
  DepthImage depth;  // [m], 0 or not finite = none
  ValueRange range;  // [m] ends of the depth scale, the same for all frames of a video
  std::string words;
};

/// Draws the frame at the images' own size: R, G, B, with even width and height as video codecs require. Frames from
/// images of equal size have equal size. Same input, same bytes. Needs no OpenGL. Any thread. Throws InputError for an
/// empty depth image and for images of different sizes.
cv::Mat3b draw_fly_frame(const FlyFrame& frame);

}  // namespace odosplat
