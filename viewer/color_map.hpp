// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace odosplat {

/// 8-bit colour, channel order R, G, B; the pixel type of all figures.
using Rgb = cv::Vec3b;

/// Purpose of a colour map. Lightness is linear along both, so that they remain readable in greyscale and for
/// colour-blind readers.
enum class ColorScale {
  depth,  // dark violet (near) through teal to yellow (far): lightness rises
  error,  // pale yellow (zero) through orange and red to dark purple: lightness falls with the error
};

/// Colour at t: 0 is the low end, 1 the high end; t is clamped to 0..1, NaN counts as 0.
/// Constructed in CIELAB (CIE 1976, D65): L* and hue are linear in t, and the chroma is the largest within the scale's
/// limit and the sRGB gamut.
Rgb scale_color(ColorScale scale, double t);

/// CIE lightness L* (0..100) of a colour, that is, its grey value in a greyscale print.
double lightness(const Rgb& color);

/// Mixes a colour with white: share 0 is the colour, 1 is white.
Rgb toward_white(const Rgb& color, double share);

/// Colours for curves: they differ in hue also for colour-blind readers, and in lightness for greyscale prints.
/// Source: the palette of Okabe and Ito 2008, in order of contrast on white. index is taken modulo its length.
Rgb series_color(std::size_t index);

/// The true path, and what joins the parts of a path where the pose was lost, in all figures of trajectories.
inline const Rgb truth_color{0, 0, 0};
inline const Rgb lost_color{0, 90, 220};

/// The two greys of the hatching that marks "no value". Neither scale contains grey, so it cannot be taken for a value.
inline const Rgb hatch_light{236, 236, 236};
inline const Rgb hatch_dark{172, 172, 172};
/// Grey of the hatching at a page pixel; `pitch` [px] >= 2 is the distance of its diagonal lines.
Rgb hatch_color(int x, int y, int pitch);

}  // namespace odosplat
