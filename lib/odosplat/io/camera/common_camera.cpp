// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/common_camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat {
namespace {

constexpr double tolerance = 0.5;  // [px]

// fx fy cx cy k1 k2 p1 p2 k3
using Parameters = std::array<double, 9>;

Parameters parameters_of(const CameraFile& file) {
  const Camera& c = file.camera;
  Parameters p{c.fx, c.fy, c.cx, c.cy};
  std::copy(file.distortion.begin(), file.distortion.end(), p.begin() + 4);
  return p;
}

bool same_size(const CameraFile& a, const CameraFile& b) {
  return a.camera.width == b.camera.width && a.camera.height == b.camera.height;
}

// The largest difference of a parameter [px]. Distortion coefficients are weighted by the shift that they cause at 45
// degrees off the axis, which is beyond the field of view of most images.
double largest_difference(const Parameters& a, const Parameters& b) {
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    largest = std::max(largest, std::abs(a[k] - b[k]) * (k < 4 ? 1.0 : std::max(a[0], a[1])));
  }
  return largest;
}

Parameters median_of(const std::vector<Parameters>& all) {
  Parameters median{};
  std::vector<double> values(all.size());
  for (std::size_t k = 0; k < median.size(); ++k) {
    for (std::size_t i = 0; i < all.size(); ++i) values[i] = all[i][k];
    median[k] = upper_median(values);
  }
  return median;
}

std::string pixels(double value) { return formatted("%.2f px", value); }

}  // namespace

CameraFile common_camera(const std::string& file, const std::vector<ImageCamera>& images, const std::string& way_out) {
  const auto refuse = [&](const ImageCamera& image, const ImageCamera& other, const std::string& how) {
    throw InputError(file, image.image,
                     "has another camera than " + other.image + " (" + how + "); a sequence has one (" + way_out + ")");
  };
  std::vector<Parameters> all;
  bool any_differs = false;
  for (const ImageCamera& image : images) {
    if (!same_size(*image.camera, *images.front().camera)) refuse(image, images.front(), "another size");
    all.push_back(parameters_of(*image.camera));
    any_differs = any_differs || all.back() != all.front();
  }
  CameraFile common = *images.front().camera;
  if (!any_differs) return common;
  const Parameters median = median_of(all);
  std::vector<double> differences;
  differences.reserve(all.size());
  for (const Parameters& p : all) differences.push_back(largest_difference(median, p));
  const auto farthest = std::max_element(differences.begin(), differences.end());
  const auto nearest = std::min_element(differences.begin(), differences.end());
  if (!(*farthest < tolerance)) {
    refuse(images[static_cast<std::size_t>(farthest - differences.begin())],
           images[static_cast<std::size_t>(nearest - differences.begin())],
           "their intrinsics differ by " + pixels(*farthest));
  }
  common.camera.fx = median[0];
  common.camera.fy = median[1];
  common.camera.cx = median[2];
  common.camera.cy = median[3];
  common.distortion.assign(median.begin() + 4, median.end());
  if (std::all_of(median.begin() + 4, median.end(), [](double d) { return d == 0.0; })) common.distortion.clear();
  log_warning(file + ": the intrinsics differ from image to image, by up to " + pixels(*farthest) +
              "; their median is used");
  return common;
}

}  // namespace odosplat
