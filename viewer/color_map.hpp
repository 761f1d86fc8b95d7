// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace odosplat {

/// 8-bit colour in the order R, G, B, the pixel of every figure.
using Rgb = cv::Vec3b;

/// What a colour map says. Both run evenly in lightness, so that they can be read in grey and by the colour-blind.
enum class ColorScale {
  depth,  // dark violet (near) through teal to yellow (far): lightness rises
  error,  // pale yellow (none) through orange and red to dark purple: lightness falls, more ink is more error
};

/// Colour at t: 0 is the low end, 1 the high end; t is clamped to 0..1, NaN counts as 0.
/// Made in CIELAB (CIE 1976, D65): L* is linear in t, the hue runs evenly and the chroma is the largest that both the
/// scale's limit and the sRGB gamut allow.
Rgb scale_color(ColorScale scale, double t);

/// CIE lightness L* (0..100) of a colour: what is left of it in a grey print.
double lightness(const Rgb& color);

/// Colour `share` (0..1) of the way to white.
Rgb toward_white(const Rgb& color, double share);

/// Colours to tell curves apart: all differ in hue for the colour-blind and in lightness for a grey print.
/// Source: the palette of Okabe and Ito 2008, in an order of contrast on white. index is taken modulo its length.
Rgb series_color(std::size_t index);

/// The two greys of the hatching that marks "no value". Grey is on neither scale, so nothing else can look like it.
inline const Rgb hatch_light{236, 236, 236};
inline const Rgb hatch_dark{172, 172, 172};
/// Grey of the hatching at a page pixel; `pitch` [px] >= 2 is the distance of its diagonal lines.
Rgb hatch_color(int x, int y, int pitch);

}  // namespace odosplat
