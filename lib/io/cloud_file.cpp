// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud_file.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/ply.hpp"

namespace odosplat {
namespace {

std::vector<Eigen::Vector3f> three_columns(const PlyElement& vertex, const char* a, const char* b, const char* c) {
  const std::vector<float> x = vertex.column(a);
  const std::vector<float> y = vertex.column(b);
  const std::vector<float> z = vertex.column(c);
  std::vector<Eigen::Vector3f> values(vertex.count);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = {x[i], y[i], z[i]};
  return values;
}

bool has_all(const PlyElement& vertex, const char* a, const char* b, const char* c) {
  return vertex.has(a) && vertex.has(b) && vertex.has(c);
}

bool is_float(PlyType type) { return type == PlyType::float32 || type == PlyType::float64; }

// Keeps the elements of `values` whose point is finite.
void keep_finite(const std::vector<Eigen::Vector3f>& points, std::vector<Eigen::Vector3f>& values) {
  if (values.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) values[kept++] = values[i];
  }
  values.resize(kept);
}

void normalise(std::vector<Eigen::Vector3f>& normals) {
  for (Eigen::Vector3f& n : normals) {
    const float length = n.norm();
    if (!std::isfinite(length) || length < 1e-6F) {
      normals.clear();
      return;
    }
    n /= length;
  }
}

}  // namespace

PointCloud parse_point_cloud(const std::string& name, const std::string& bytes) {
  const PlyFile file = parse_ply(name, bytes);
  const PlyElement* vertex = file.find("vertex");
  if (vertex == nullptr) throw InputError(name, "header", "has no vertices");
  if (!has_all(*vertex, "x", "y", "z")) throw InputError(name, "header", "vertices have no x, y, z");
  PointCloud cloud;
  const std::vector<Eigen::Vector3f> points = three_columns(*vertex, "x", "y", "z");
  if (has_all(*vertex, "red", "green", "blue")) {
    cloud.colors = three_columns(*vertex, "red", "green", "blue");
    const float scale = is_float(vertex->find("red")->type) ? 1.0F : 1.0F / 255.0F;
    for (Eigen::Vector3f& c : cloud.colors) {
      c *= scale;
      for (float& v : c) v = std::isfinite(v) ? std::clamp(v, 0.0F, 1.0F) : 0.0F;
    }
  }
  if (has_all(*vertex, "nx", "ny", "nz")) cloud.normals = three_columns(*vertex, "nx", "ny", "nz");
  cloud.points = points;
  keep_finite(points, cloud.points);
  keep_finite(points, cloud.colors);
  keep_finite(points, cloud.normals);
  normalise(cloud.normals);
  if (cloud.points.empty()) throw InputError(name, "holds no points");
  if (cloud.points.size() < points.size()) {
    log_warning(name + ": " + std::to_string(points.size() - cloud.points.size()) + " points are not finite: dropped");
  }
  return cloud;
}

PointCloud read_point_cloud(const std::string& path) { return parse_point_cloud(path, read_file(path)); }

void write_point_cloud(const std::string& path, const PointCloud& cloud) {
  std::vector<PlyColumn> columns;
  auto add_floats = [&](const std::vector<Eigen::Vector3f>& values, const char* prefix) {
    for (int k = 0; k < 3; ++k) {
      std::vector<float> column(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) column[i] = values[i][k];
      columns.push_back({prefix + std::string(1, "xyz"[k]), std::move(column)});
    }
  };
  add_floats(cloud.points, "");
  if (cloud.has_normals()) add_floats(cloud.normals, "n");
  if (cloud.has_colors()) {
    const char* names[3] = {"red", "green", "blue"};
    for (int k = 0; k < 3; ++k) {
      std::vector<std::uint8_t> column(cloud.size());
      for (std::size_t i = 0; i < cloud.size(); ++i) {
        column[i] = static_cast<std::uint8_t>(std::lround(std::clamp(cloud.colors[i][k], 0.0F, 1.0F) * 255.0F));
      }
      columns.push_back({names[k], std::move(column)});
    }
  }
  write_ply(path, {}, "vertex", columns);
}

}  // namespace odosplat
