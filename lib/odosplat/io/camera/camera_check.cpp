// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_check.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/number_text.hpp"

namespace odosplat {
namespace {

/// The lens distortion on the plane z = 1, with the same model as Undistorter.
class Lens {
 public:
  explicit Lens(const std::vector<double>& d)
      : k1_(d[0]), k2_(d[1]), p1_(d[2]), p2_(d[3]), k3_(d.size() > 4 ? d[4] : 0.0) {}

  Eigen::Vector2d distorted(const Eigen::Vector2d& p) const {
    const double r2 = p.squaredNorm();
    const double xy = p.x() * p.y();
    return p * radial(r2) + Eigen::Vector2d(2.0 * p1_ * xy + p2_ * (r2 + 2.0 * p.x() * p.x()),
                                            p1_ * (r2 + 2.0 * p.y() * p.y()) + 2.0 * p2_ * xy);
  }

  Eigen::Matrix2d slope(const Eigen::Vector2d& p) const {
    const double r2 = p.squaredNorm();
    const double growth = 2.0 * (k1_ + r2 * (2.0 * k2_ + r2 * 3.0 * k3_));  // 2 d radial / d r^2
    Eigen::Matrix2d J = radial(r2) * Eigen::Matrix2d::Identity() + growth * p * p.transpose();
    J(0, 0) += 2.0 * p1_ * p.y() + 6.0 * p2_ * p.x();
    J(0, 1) += 2.0 * p1_ * p.x() + 2.0 * p2_ * p.y();
    J(1, 0) += 2.0 * p1_ * p.x() + 2.0 * p2_ * p.y();
    J(1, 1) += 6.0 * p1_ * p.y() + 2.0 * p2_ * p.x();
    return J;
  }

 private:
  double radial(double r2) const { return 1.0 + r2 * (k1_ + r2 * (k2_ + r2 * k3_)); }

  double k1_;
  double k2_;
  double p1_;
  double p2_;
  double k3_;
};

/// Whether the distortion's Jacobian has a positive determinant everywhere between two rays. Otherwise the rays lie on
/// different sides of a fold.
bool same_side(const Lens& lens, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  constexpr int samples = 8;
  for (int i = 1; i <= samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    if (!(lens.slope(from + share * (to - from)).determinant() > 0.0)) return false;
  }
  return true;
}

/// The fraction of the way from the axis to `target` (both on the distorted plane z = 1) up to which every point shows
/// exactly one ray. The ray is followed outward by Newton's method until the Jacobian's determinant is not positive.
double reach(const Lens& lens, const Eigen::Vector2d& target) {
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
  const Lens lens(distortion);
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
  if (file.gamma != 0.0) require_range("gamma", file.gamma, camera_limits::least_gamma, camera_limits::most_gamma);
}

void check_camera(const std::string& name, const CameraFile& file) {
  try {
    check_camera(file);
  } catch (const InputError& e) {
    throw InputError(name, e.what());
  }
}

}  // namespace odosplat
