// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figure_view.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace odosplat {
namespace {

Eigen::Vector2d mean_and_spread_axis(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p;
  mean /= static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(scatter).eigenvectors().col(1);
}

double spread_along(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& axis) {
  double sum = 0.0;
  double squares = 0.0;
  for (const auto& p : points) {
    const double x = p.dot(axis);
    sum += x;
    squares += x * x;
  }
  const auto n = static_cast<double>(points.size());
  return squares / n - (sum / n) * (sum / n);
}

/// Sets focal, cx and cy so that the points (x, y in the picture's plane) fill the picture, centred, within the margin.
void fit(const std::vector<Eigen::Vector2d>& points, double margin, FigureView& view) {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  for (const auto& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const double free_x = view.size.width * (1.0 - 2.0 * margin);
  const double free_y = view.size.height * (1.0 - 2.0 * margin);
  const Eigen::Vector2d extent = (high - low).cwiseMax(1e-9);
  view.focal = std::min(free_x / extent.x(), free_y / extent.y());
  view.cx = 0.5 * (view.size.width - 1) - view.focal * 0.5 * (low.x() + high.x());
  view.cy = 0.5 * (view.size.height - 1) - view.focal * 0.5 * (low.y() + high.y());
}

/// The finite points; if there are none or all coincide, points at 0.5 m from the origin or from that point are added.
std::vector<Eigen::Vector3d> something_to_see(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  std::vector<Eigen::Vector3d> seen;
  for (const auto& p : points) {
    if (!p.allFinite()) continue;
    box.extend(p);
    seen.push_back(p);
  }
  if (seen.empty()) box.extend(Eigen::Vector3d::Zero());
  if (seen.empty() || box.diagonal().norm() < 1e-6) {
    for (const double s : {-0.5, 0.5}) {
      for (int axis = 0; axis < 3; ++axis) seen.emplace_back(box.center() + s * Eigen::Vector3d::Unit(axis));
    }
  }
  return seen;
}

Eigen::Vector3d middle(const std::vector<Eigen::Vector3d>& points) {
  Eigen::AlignedBox3d box;
  for (const auto& p : points) box.extend(p);
  return box.center();
}

}  // namespace

std::optional<Eigen::Vector2d> FigureView::project(const Eigen::Vector3d& p_world) const {
  const Eigen::Vector3d p_view = T_world_view.inverse() * p_world;
  if (perspective && !(p_view.z() > 0.0)) return std::nullopt;
  const double scale = perspective ? focal / p_view.z() : focal;
  return Eigen::Vector2d(scale * p_view.x() + cx, scale * p_view.y() + cy);
}

double FigureView::pixels_per_metre(const Eigen::Vector3d& p_world) const {
  if (!perspective) return focal;
  const double z = (T_world_view.inverse() * p_world).z();
  return z > 0.0 ? focal / z : 0.0;
}

Eigen::Vector3d estimate_up(const Trajectory& cameras) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& pose : cameras) sum -= pose.T_world_camera.rotation() * Eigen::Vector3d::UnitY();
  if (sum.norm() < 1e-6 * std::max<double>(1.0, static_cast<double>(cameras.size()))) return Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up = sum.normalized();
  int axis = 0;
  const double largest = up.cwiseAbs().maxCoeff(&axis);
  const double cos_30_deg = std::sqrt(0.75);
  return largest >= cos_30_deg ? Eigen::Vector3d(std::copysign(1.0, up[axis]) * Eigen::Vector3d::Unit(axis)) : up;
}

PlanAxes plan_axes(const Eigen::Vector3d& up, const std::vector<Eigen::Vector3f>& points,
                   const std::vector<Eigen::Vector3f>& normals) {
  PlanAxes axes;
  axes.up = up.norm() > 1e-12 ? up.normalized() : Eigen::Vector3d::UnitZ();
  int least = 0;
  axes.up.cwiseAbs().minCoeff(&least);
  const Eigen::Vector3d a = (Eigen::Vector3d::Unit(least) - axes.up * axes.up[least]).normalized();
  const Eigen::Vector3d b = axes.up.cross(a);

  const std::size_t stride = points.size() / 50000 + 1;
  std::vector<Eigen::Vector2d> flat;
  std::complex<double> agreed = 0.0;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    const Eigen::Vector3d p = points[i].cast<double>();
    if (!p.allFinite()) continue;
    flat.emplace_back(p.dot(a), p.dot(b));
    if (normals.size() != points.size()) continue;
    const Eigen::Vector3d n = normals[i].cast<double>();
    const std::complex<double> level(n.dot(a), n.dot(b));
    // The fourth power maps the four horizontal directions of a room's walls to one angle; normals of floors and
    // ceilings have no horizontal part and contribute nothing.
    if (n.allFinite()) agreed += level * level * level * level;
  }
  double angle = 0.0;
  if (!flat.empty()) {
    const Eigen::Vector2d wide = mean_and_spread_axis(flat);
    angle = std::atan2(wide.y(), wide.x());
    if (std::abs(agreed) > 0.02 * static_cast<double>(flat.size())) {
      angle = std::arg(agreed) / 4.0;
      const Eigen::Vector2d along(std::cos(angle), std::sin(angle));
      if (spread_along(flat, {-along.y(), along.x()}) > spread_along(flat, along)) angle += 2.0 * std::atan(1.0);
    }
  }
  axes.right = std::cos(angle) * a + std::sin(angle) * b;
  axes.forward = axes.up.cross(axes.right);
  return axes;
}

FigureView view_from_above(const PlanAxes& axes, const std::vector<Eigen::Vector3d>& points, cv::Size size,
                           double margin) {
  const auto seen = something_to_see(points);
  Eigen::Matrix3d R_world_view;
  R_world_view << axes.right, -axes.forward, -axes.up;
  FigureView view;
  view.size = size;
  view.perspective = false;
  view.T_world_view = SE3(R_world_view, middle(seen));
  std::vector<Eigen::Vector2d> flat;
  flat.reserve(seen.size());
  const SE3 T_view_world = view.T_world_view.inverse();
  for (const auto& p : seen) flat.emplace_back((T_view_world * p).head<2>());
  fit(flat, margin, view);
  return view;
}

FigureView view_from_corner(const PlanAxes& axes, const std::vector<Eigen::Vector3d>& points, cv::Size size,
                            double margin, double azimuth, double elevation) {
  const auto seen = something_to_see(points);
  const Eigen::Vector3d center = middle(seen);
  const Eigen::Vector3d level = std::cos(azimuth) * axes.forward + std::sin(azimuth) * axes.right;
  const Eigen::Vector3d z = std::cos(elevation) * level - std::sin(elevation) * axes.up;
  const Eigen::Vector3d x = level.cross(axes.up);
  Eigen::Matrix3d R_world_view;
  R_world_view << x, z.cross(x), z;
  double radius = 0.0;
  for (const auto& p : seen) radius = std::max(radius, (p - center).norm());
  FigureView view;
  view.size = size;
  // This distance gives a moderate perspective.
  view.T_world_view = SE3(R_world_view, center - 3.0 * radius * z);
  std::vector<Eigen::Vector2d> flat;
  const SE3 T_view_world = view.T_world_view.inverse();
  for (const auto& p : seen) {
    const Eigen::Vector3d p_view = T_view_world * p;
    flat.emplace_back(p_view.head<2>() / p_view.z());
  }
  fit(flat, margin, view);
  return view;
}

}  // namespace odosplat
