// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/camera/undistort.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace odosplat {

Undistorter::Undistorter(const Camera& camera, const std::vector<double>& distortion) : camera_(camera) {
  if (std::all_of(distortion.begin(), distortion.end(), [](double d) { return d == 0.0; })) return;
  lens_ = LensModel(distortion);
  // r (1 + k1 r^2 + ...) increases up to the first root of its derivative 1 + 3 k1 r^2 + 5 k2 r^4 + 7 k3 r^6.
  double turn = std::numeric_limits<double>::infinity();  // in r^2
  for (double r2 = 0.0; r2 < 10.0; r2 += 1e-3) {
    if (lens_.radial_slope(r2) <= 0.0) {
      turn = r2;
      break;
    }
  }
  source_.create(camera.height, camera.width);
  for (int v = 0; v < camera.height; ++v) {
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d p = distort(u, v);
      const double r2 = camera.ray(u, v).head<2>().squaredNorm();
      const bool seen =
          r2 < turn && p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= camera.width - 1 && p.y() <= camera.height - 1;
      source_(v, u) = seen ? cv::Vec2f(static_cast<float>(p.x()), static_cast<float>(p.y())) : cv::Vec2f(-1.0F, -1.0F);
    }
  }
}

Eigen::Vector2d Undistorter::distort(double u, double v) const {
  const Eigen::Vector2d p = lens_.distorted(camera_.ray(u, v).head<2>());
  return {camera_.fx * p.x() + camera_.cx, camera_.fy * p.y() + camera_.cy};
}

ColorImage Undistorter::color(const ColorImage& distorted) const {
  if (is_identity()) return distorted;
  ColorImage image(distorted.size(), cv::Vec3f(0.0F, 0.0F, 0.0F));
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const cv::Vec2f p = source_(v, u);
      if (p[0] < 0.0F) continue;
      const int x0 = static_cast<int>(p[0]);
      const int y0 = static_cast<int>(p[1]);
      const int x1 = std::min(x0 + 1, image.cols - 1);
      const int y1 = std::min(y0 + 1, image.rows - 1);
      const float a = p[0] - static_cast<float>(x0);
      const float b = p[1] - static_cast<float>(y0);
      image(v, u) = (1.0F - b) * ((1.0F - a) * distorted(y0, x0) + a * distorted(y0, x1)) +
                    b * ((1.0F - a) * distorted(y1, x0) + a * distorted(y1, x1));
    }
  }
  return image;
}

void Undistorter::mask_unseen(DepthImage& depth) const {
  for (int y = 0; y < source_.rows; ++y) {
    for (int x = 0; x < source_.cols; ++x) {
      if (source_(y, x)[0] < 0.0F) depth(y, x) = 0.0F;
    }
  }
}

DepthImage Undistorter::depth(const DepthImage& distorted) const {
  if (is_identity()) return distorted;
  DepthImage image(distorted.size(), 0.0F);
  for (int v = 0; v < image.rows; ++v) {
    for (int u = 0; u < image.cols; ++u) {
      const cv::Vec2f p = source_(v, u);
      if (p[0] >= 0.0F) image(v, u) = distorted(cvRound(p[1]), cvRound(p[0]));
    }
  }
  return image;
}

}  // namespace odosplat
