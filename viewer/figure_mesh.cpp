// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "viewer/figure_mesh.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace odosplat {

std::int32_t FigureMesh::add_vertex(const Eigen::Vector3d& p_world, const Rgb& color) {
  vertices_.emplace_back((p_world - origin_).cast<float>());
  colors_.push_back(color);
  return static_cast<std::int32_t>(vertices_.size() - 1);
}

void FigureMesh::add_disc(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double radius, int sides,
                          const Rgb& color) {
  const Eigen::Vector3d x = normal.unitOrthogonal();
  const Eigen::Vector3d y = normal.cross(x);
  const auto first = static_cast<std::int32_t>(vertices_.size());
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    add_vertex(center + radius * (std::cos(angle) * x + std::sin(angle) * y), color);
  }
  for (int i = 1; i + 1 < sides; ++i) triangles_.push_back({first, first + i, first + i + 1});
}

void FigureMesh::add_tube(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius, const Rgb& color_a,
                          const Rgb& color_b) {
  constexpr int sides = 6;
  const double length = (b - a).norm();
  if (!(length > 0.0) || !std::isfinite(length)) return;
  const Eigen::Vector3d axis = (b - a) / length;
  const Eigen::Vector3d x = axis.unitOrthogonal();
  const Eigen::Vector3d y = axis.cross(x);
  const auto first = static_cast<std::int32_t>(vertices_.size());
  for (int i = 0; i < sides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / sides;
    const Eigen::Vector3d offset = radius * (std::cos(angle) * x + std::sin(angle) * y);
    add_vertex(a + offset, color_a);
    add_vertex(b + offset, color_b);
  }
  for (int i = 0; i < sides; ++i) {
    const std::int32_t p = first + 2 * i;
    const std::int32_t q = first + 2 * ((i + 1) % sides);
    triangles_.push_back({p, q, q + 1});
    triangles_.push_back({p, q + 1, p + 1});
  }
}

void FigureMesh::add_ball(const Eigen::Vector3d& center, double radius, const Rgb& color) {
  constexpr int rings = 4;
  constexpr int sides = 8;
  if (!center.allFinite()) return;
  const std::int32_t top = add_vertex(center + Eigen::Vector3d(0.0, 0.0, radius), color);
  const std::int32_t bottom = add_vertex(center - Eigen::Vector3d(0.0, 0.0, radius), color);
  const auto first = static_cast<std::int32_t>(vertices_.size());
  for (int r = 1; r < rings; ++r) {
    const double polar = std::numbers::pi * r / rings;
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      add_vertex(center + radius * Eigen::Vector3d(std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle),
                                                   std::cos(polar)),
                 color);
    }
  }
  const auto at = [&](int r, int i) { return first + (r - 1) * sides + i % sides; };
  for (int i = 0; i < sides; ++i) {
    triangles_.push_back({top, at(1, i), at(1, i + 1)});
    triangles_.push_back({bottom, at(rings - 1, i + 1), at(rings - 1, i)});
    for (int r = 1; r + 1 < rings; ++r) {
      triangles_.push_back({at(r, i), at(r + 1, i), at(r + 1, i + 1)});
      triangles_.push_back({at(r, i), at(r + 1, i + 1), at(r, i + 1)});
    }
  }
}

void FigureMesh::add_path(const std::vector<Eigen::Vector3d>& points, double radius, const std::vector<Rgb>& colors) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rgb& color = colors.size() == 1 ? colors[0] : colors[i];
    add_ball(points[i], radius, color);
    if (i > 0) add_tube(points[i - 1], points[i], radius, colors.size() == 1 ? color : colors[i - 1], color);
  }
}

void FigureMesh::add_dashed_path(const std::vector<Eigen::Vector3d>& points, double radius, const Rgb& color,
                                 double dash) {
  double walked = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Eigen::Vector3d step = points[i + 1] - points[i];
    const double length = step.norm();
    if (!(length > 0.0) || length > 1e5 * dash) continue;
    double begin = 0.0;
    while (begin < length) {
      const double phase = std::fmod(walked + begin, 2.0 * dash);
      const bool inked = phase < dash;
      const double end = std::min(length, begin + (inked ? dash - phase : 2.0 * dash - phase) + 1e-6 * dash);
      if (inked) {
        const Eigen::Vector3d a = points[i] + step * (begin / length);
        const Eigen::Vector3d b = points[i] + step * (end / length);
        add_tube(a, b, radius, color, color);
        add_ball(b, radius, color);  // fills the gaps at the joints of short pieces
      }
      begin = end;
    }
    walked += length;
  }
}

}  // namespace odosplat
