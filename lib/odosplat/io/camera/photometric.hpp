// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "odosplat/io/image/image_file.hpp"

namespace odosplat {

/// Converts a stored image to the one that the same camera would have stored with exposure 1 and without vignetting, so
/// that equal radiance has equal colour everywhere in an image and in all images of a sequence:
///   I' = f(f^-1(I) / (V e)),  f(L) = L^(1 / gamma)
/// Source: the image model of DSO (Engel, Usenko, Cremers 2016). Differences: the result is in stored colours, not in
/// irradiance; the response is a power law, for which the correction is one factor per pixel, (V e)^(-1 / gamma).
/// Saturated channels (254.5 of 255 and more) are not changed, because their true brightness is unknown. Results above
/// white are clamped to white. Pixels where the vignette is 0 become black. Const calls are thread safe.
class PhotometricCorrection {
 public:
  /// The identity: images are returned bit by bit unchanged.
  PhotometricCorrection() = default;
  /// gamma: exponent of the response, stored = radiance^(1 / gamma), > 0. vignette: of the images' size, 0..1, 1 where
  /// the lens is brightest; empty: none. InputError for a value out of range.
  PhotometricCorrection(double gamma, const cv::Mat1f& vignette);

  /// exposure: relative to the exposure that counts as 1, > 0. Throws InputError for an image whose size differs from
  /// the vignette's, or for an exposure out of range.
  ColorImage apply(const ColorImage& image, double exposure) const;

 private:
  double gamma_ = 1.0;
  cv::Mat1f gain_;  // V^(-1 / gamma), 0 where the vignette is 0; empty: 1 everywhere
};

/// Vignette from an image file as in DSO's calibrations: grey, 8 or 16 bits, divided by its largest value. Throws
/// InputError naming the file: missing, larger than the limit, damaged, black everywhere.
cv::Mat1f read_vignette(const std::string& path, const ImageLimit& limit = {});

/// Exposure times of a list, each divided by their median.
///   exposures.txt  "time exposure" per line; every frame must have an entry at most 0.01 s away
///   times.txt      "id time exposure" per line (DSO), line k for frame k; as many lines as frames
/// Exposures may be in any unit; none may be under 1e-6 or over 1e6 times the median. `frame_times` [s] are ascending.
/// Throws InputError(name, fault): a line of another form, an exposure that is not positive, a frame without one,
/// another number of lines. Other data sets have a times.txt too: if its first line is not of DSO's form, it has no
/// exposures and the result is empty.
std::vector<double> parse_exposures(const std::string& name, const std::string& text,
                                    const std::vector<double>& frame_times);
std::vector<double> parse_dso_times(const std::string& name, const std::string& text, std::size_t frames);

/// The exposures of a sequence's folder, from exposures.txt, else times.txt; empty if there are none, which means 1 for
/// all frames.
std::vector<double> read_exposures(const std::string& folder, const std::vector<double>& frame_times);

}  // namespace odosplat
