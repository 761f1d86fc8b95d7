// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>

namespace odosplat {

/// Pinhole camera without distortion: u = fx x/z + cx, v = fy y/z + cy [px]. x right, y down, z forward.
/// Pixel (0,0) is the CENTRE of the top-left pixel, so the image covers [-0.5, width - 0.5).
struct Camera {
  int width = 0;
  int height = 0;
  double fx = 0.0;  // [px], > 0
  double fy = 0.0;  // [px], > 0
  double cx = 0.0;  // [px]
  double cy = 0.0;  // [px]
  /// [s] Time between the first row and the last of a rolling shutter, negative if the last row is taken first; 0: all
  /// rows at once. An image's time and pose are those of its middle row (time_of_row).
  double readout = 0.0;

  /// Throws InputError naming the field: sizes in 1..32768, focal lengths from a thousandth of the image to 1e6 px, the
  /// principal point within 32768 px of the image, a readout of at most 1 s.
  void check() const;

  /// Projects p_camera [m], which must have z > 0, to a pixel.
  Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx * p_camera.x() / p_camera.z() + cx, fy * p_camera.y() / p_camera.z() + cy};
  }
  /// The point at depth z = 1 on the ray of a pixel.
  Eigen::Vector3d ray(double u, double v) const { return {(u - cx) / fx, (v - cy) / fy, 1.0}; }
  Eigen::Matrix3d matrix() const;
  /// When a row is taken, as a share of the readout time after the middle row: -0.5..0.5 within the image.
  double time_of_row(double v) const { return (v + 0.5) / height - 0.5; }

  /// Camera of pyramid level l >= 0, each level half the size (odd last rows and columns are dropped):
  /// u -> (u + 0.5) / 2 - 0.5.
  Camera level(int l) const;
  /// Camera of the same view at another size; the two axes are scaled independently.
  Camera resized(int new_width, int new_height) const;

  bool operator==(const Camera&) const = default;
};

}  // namespace odosplat
