// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

#include "odosplat/core/image.hpp"
#include "odosplat/io/image/image_file.hpp"

namespace odosplat {

/// Makes of a stored image what the same camera would have stored with exposure 1 and without vignetting, so that one
/// colour stands for one radiance all over an image and all along a sequence:
///   I' = f(f^-1(I) / (V e)),  f(L) = L^(1 / gamma)
/// Source: the image model of DSO (Engel, Usenko, Cremers 2016). Differs: the result is in stored colours, not in
/// irradiance; the response is a power. With a power the correction is one factor a pixel, (V e)^(-1 / gamma).
/// Channels that are saturated (254.5 of 255 and more) stay as they are: how bright they were nobody knows. What the
/// correction makes brighter than white becomes white. Where the vignette is 0 the lens sees nothing: black. Const
/// calls are thread safe.
class PhotometricCorrection {
 public:
  /// Changes nothing, to the bit.
  PhotometricCorrection() = default;
  /// gamma: exponent of the response, stored = radiance^(1 / gamma), > 0. vignette: of the images' size, 0..1, 1 where
  /// the lens is brightest; empty: none. InputError for a value out of range.
  PhotometricCorrection(double gamma, const cv::Mat1f& vignette);

  /// exposure: relative to what counts as 1, > 0. InputError for an image of another size than the vignette, or a bad
  /// exposure.
  ColorImage apply(const ColorImage& image, double exposure) const;

 private:
  double gamma_ = 1.0;
  cv::Mat1f gain_;  // V^(-1 / gamma), 0 where the lens sees nothing; empty: 1 everywhere
};

/// Vignette from an image file, as DSO's calibration has it: grey, 8 or 16 bits, divided by its largest value.
/// InputError naming the file: missing, beyond the limit, damaged, black everywhere.
cv::Mat1f read_vignette(const std::string& path, const ImageLimit& limit = {});

/// Exposure times of a list, each over their median.
///   exposures.txt  "time exposure" a line; frames find theirs by time, at most 0.01 s away, and all must find one
///   times.txt      "id time exposure" a line (DSO), line k for frame k; as many lines as frames
/// The unit of exposures is free; none may be under 1e-6 or over 1e6 times the median. `frame_times` [s] ascend.
/// InputError(name, fault): a line of another form, an exposure that is not positive, a frame without one, another
/// number of lines. Other data sets have a times.txt too: one whose first line is not of DSO's form has no exposures,
/// and the answer is empty.
std::vector<double> parse_exposures(const std::string& name, const std::string& text,
                                    const std::vector<double>& frame_times);
std::vector<double> parse_dso_times(const std::string& name, const std::string& text, std::size_t frames);

/// The exposures of a sequence's folder, from exposures.txt, else times.txt; empty if there are none: then all are 1.
std::vector<double> read_exposures(const std::string& folder, const std::vector<double>& frame_times);

}  // namespace odosplat
