// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "viewer/color_map.hpp"

namespace odosplat {

/// Coloured triangles, the only primitive that the viewer passes to OpenGL: discs, tubes and balls of any size look the
/// same on every device, unlike OpenGL's points and wide lines. Positions [m] in the map's world frame minus `origin`,
/// so that maps far from zero keep their precision in 32 bits. No lighting: colours are drawn unchanged.
class FigureMesh {
 public:
  FigureMesh() = default;
  explicit FigureMesh(Eigen::Vector3d origin) : origin_(std::move(origin)) {}

  /// Regular polygon with `sides` >= 3 around `center` (world); its front faces along `normal` (unit length).
  void add_disc(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double radius, int sides,
                const Rgb& color);
  /// Six-sided tube from a to b (world), its colour interpolated from color_a to color_b; nothing if a = b.
  void add_tube(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius, const Rgb& color_a,
                const Rgb& color_b);
  void add_ball(const Eigen::Vector3d& center, double radius, const Rgb& color);
  /// Tubes along the points, with balls at the joints; colors has one colour for each point, or a single one for all.
  void add_path(const std::vector<Eigen::Vector3d>& points, double radius, const std::vector<Rgb>& colors);
  /// Dashes and gaps of length `dash` [m] along the points.
  void add_dashed_path(const std::vector<Eigen::Vector3d>& points, double radius, const Rgb& color, double dash);

  const Eigen::Vector3d& origin() const { return origin_; }
  const std::vector<Eigen::Vector3f>& vertices() const { return vertices_; }
  const std::vector<Rgb>& colors() const { return colors_; }
  /// Vertex indices, counter-clockwise seen from the front.
  const std::vector<std::array<std::int32_t, 3>>& triangles() const { return triangles_; }
  bool empty() const { return triangles_.empty(); }

 private:
  std::int32_t add_vertex(const Eigen::Vector3d& p_world, const Rgb& color);

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Rgb> colors_;
  std::vector<std::array<std::int32_t, 3>> triangles_;
};

}  // namespace odosplat
