// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_check.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/camera/lens_model.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

/// Whether the distortion's Jacobian has a positive determinant everywhere between two rays. Otherwise the rays lie on
/// different sides of a fold.
bool same_side(const LensModel& lens, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  constexpr int samples = 8;
  for (int i = 1; i <= samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    if (!(lens.slope(from + share * (to - from)).determinant() > 0.0)) return false;
  }
  return true;
}

/// The fraction of the way from the axis to `target` (both on the distorted plane z = 1) up to which every point shows
/// exactly one ray. The ray is followed outward by Newton's method until the Jacobian's determinant is not positive.
double reach(const LensModel& lens, const Eigen::Vector2d& target) {
  constexpr int steps = 64;
  constexpr int iterations = 20;
  constexpr double precision = 1e-9;
  Eigen::Vector2d ray = Eigen::Vector2d::Zero();
  for (int k = 1; k <= steps; ++k) {
    const Eigen::Vector2d wanted = target * (static_cast<double>(k) / steps);
    const Eigen::Vector2d before = ray;
    bool found = false;
    for (int i = 0; i < iterations && !found; ++i) {
      const Eigen::Matrix2d J = lens.slope(ray);
      if (!(J.determinant() > 0.0)) break;
      ray += J.inverse() * (wanted - lens.distorted(ray));
      if (!ray.allFinite()) break;
      found = (wanted - lens.distorted(ray)).norm() < precision;
    }
    if (!found || !same_side(lens, before, ray)) return static_cast<double>(k - 1) / steps;
  }
  return 1.0;
}

void require_range(const char* key, double value, double least, double most) {
  if (value >= least && value <= most) return;
  throw InputError(key, "must be in " + number_text(least) + ".." + number_text(most) + ", is " + number_text(value));
}

void check_distortion(const Camera& camera, const std::vector<double>& distortion) {
  if (distortion.empty()) return;
  if (distortion.size() != 4 && distortion.size() != 5) {
    throw InputError("distortion", "must hold 4 or 5 numbers, holds " + std::to_string(distortion.size()));
  }
  if (!std::all_of(distortion.begin(), distortion.end(), [](double d) { return std::isfinite(d); })) {
    throw InputError("distortion", "is not finite");
  }
  const double radius = fold_radius(camera, distortion);
  // The model of a wide lens with one coefficient often folds before the image's corners. That is accepted: Undistorter
  // leaves such corners out.
  const double to_sides =
      std::max({camera.cx, camera.width - 1.0 - camera.cx, camera.cy, camera.height - 1.0 - camera.cy});
  if (radius >= to_sides) return;
  std::string values;
  for (const double d : distortion) values += (values.empty() ? "[" : ", ") + number_text(d);
  throw InputError("distortion", values + "] folds within the image: about " + number_text(std::floor(radius)) +
                                     " px from cx, cy the lens shows two rays in one pixel, and beyond that none");
}

void check_depth_camera(const CameraFile& file) {
  const DepthCamera& depth = *file.depth_camera;
  try {
    depth.camera.check();
  } catch (const InputError& e) {
    throw InputError(std::string("depth_camera.") + e.what());
  }
  require_range("depth_camera.width", depth.camera.width, 2, 32768);
  require_range("depth_camera.height", depth.camera.height, 2, 32768);
  const Eigen::Vector3d& t = depth.T_color_depth.translation();
  if (!depth.T_color_depth.is_finite() || !(t.norm() <= camera_limits::most_baseline)) {
    throw InputError("depth_camera.T_color_depth", "its translation must be at most " +
                                                       number_text(camera_limits::most_baseline) + " m, is " +
                                                       number_text(t.norm()));
  }
  require_range("depth_camera.time_offset", depth.time_offset, -camera_limits::most_time_offset,
                camera_limits::most_time_offset);
  // The sign says that the world is reflected, which a motion between two cameras cannot express.
  if (file.fy_sign < 0) throw InputError("depth_camera", "does not go with a negative fy");
}

}  // namespace

double fold_radius(const Camera& camera, const std::vector<double>& distortion) {
  double radius = std::numeric_limits<double>::infinity();
  if (std::all_of(distortion.begin(), distortion.end(), [](double d) { return d == 0.0; })) return radius;
  const LensModel lens(distortion);
  constexpr int places = 16;  // samples per side of the border, including the corners
  const Eigen::Vector2d last(camera.width - 1.0, camera.height - 1.0);
  const Eigen::Vector2d centre(camera.cx, camera.cy);
  for (int k = 0; k < places; ++k) {
    const double share = static_cast<double>(k) / places;
    for (const Eigen::Vector2d& pixel :
         {Eigen::Vector2d(share * last.x(), 0.0), Eigen::Vector2d(last.x(), share * last.y()),
          Eigen::Vector2d((1.0 - share) * last.x(), last.y()), Eigen::Vector2d(0.0, (1.0 - share) * last.y())}) {
      const double part = reach(lens, camera.ray(pixel.x(), pixel.y()).head<2>());
      if (part < 1.0) radius = std::min(radius, part * (pixel - centre).norm());
    }
  }
  return radius;
}

void check_camera(const CameraFile& file) {
  file.camera.check();
  check_distortion(file.camera, file.distortion);
  if (file.depth_camera) check_depth_camera(file);
  require_range("depth_scale", file.depth_scale, camera_limits::least_depth_scale, camera_limits::most_depth_scale);
  if (file.fps != 0.0) require_range("fps", file.fps, 1.0 / camera_limits::most_fps, camera_limits::most_fps);
  require_range("time_offset", file.time_offset, -camera_limits::most_time_offset, camera_limits::most_time_offset);
  if (file.gamma != 0.0) require_range("gamma", file.gamma, camera_limits::least_gamma, camera_limits::most_gamma);
}

void check_camera(const std::string& name, const CameraFile& file) {
  try {
    check_camera(file);
  } catch (const InputError& e) {
    throw InputError(name, e.what());
  }
}

void check_turned_rows(const std::string& name, int quarters, const Camera& camera, const std::string& file) {
  if (quarters % 2 == 0 || camera.readout == 0.0) return;
  throw InputError(name, "is shown turned by " + std::to_string(90 * quarters) +
                             " degrees clockwise, so that what was taken one row after the other are its columns: "
                             "line_time of " +
                             file + " cannot be used");
}

}  // namespace odosplat
