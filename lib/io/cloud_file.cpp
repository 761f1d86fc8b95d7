// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"

namespace odosplat {
namespace {

using Names = std::array<const char*, 3>;
using Vectors = std::vector<Eigen::Vector3f>;

Vectors interleave(const Ply& ply, const Names& names) {
  Vectors vectors(ply.element("vertex").count);
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<float> column = ply.column<float>("vertex", names[static_cast<std::size_t>(axis)]);
    for (std::size_t i = 0; i < vectors.size(); ++i) vectors[i][axis] = column[i];
  }
  return vectors;
}

std::optional<Names> first_complete(const PlyElement& vertex, std::initializer_list<Names> choices) {
  for (const Names& names : choices) {
    if (std::all_of(names.begin(), names.end(), [&](const char* name) { return vertex.has(name); })) return names;
  }
  return std::nullopt;
}

// The value of full colour: unsigned integers use their range; floats see the header.
float full_scale(const PlyColumn& column) {
  return std::visit(
      [](const auto& values) -> float {
        using T = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_floating_point_v<T>) {
          return std::any_of(values.begin(), values.end(), [](T v) { return v > T{1}; }) ? 255.0F : 1.0F;
        } else if constexpr (std::is_same_v<T, std::uint16_t>) {
          return 65535.0F;
        } else {
          return 255.0F;
        }
      },
      column);
}

Vectors read_colors(const Ply& ply, const Names& names) {
  const PlyElement& vertex = ply.element("vertex");
  float scale = 0.0F;
  for (const char* name : names) scale = std::max(scale, full_scale(*vertex.find(name)));
  Vectors colors = interleave(ply, names);
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (!colors[i].allFinite() || colors[i].minCoeff() < 0.0F) {
      throw InputError(ply.file, "vertex " + std::to_string(i + 1), "its colour is no colour");
    }
    colors[i] = (colors[i] / scale).cwiseMin(1.0F);
  }
  return colors;
}

Vectors read_normals(const Ply& ply, const Names& names, const std::vector<bool>& kept) {
  Vectors normals = interleave(ply, names);
  std::size_t without = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (!kept[i]) continue;
    ++points;
    const float length = normals[i].norm();
    if (!std::isfinite(length) || length < 1e-6F) {
      ++without;
    } else {
      normals[i] /= length;
    }
  }
  if (without == 0) return normals;
  if (without < points) {
    log_warning(ply.file + ": " + std::to_string(without) + " of " + std::to_string(points) +
                " points have no normal; all normals are left out");
  }
  return {};
}

void keep_only(const std::vector<bool>& kept, Vectors& vectors) {
  if (vectors.empty()) return;
  std::size_t n = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (kept[i]) vectors[n++] = vectors[i];
  }
  vectors.resize(n);
}

std::vector<float> axis_of(const Vectors& vectors, int axis) {
  std::vector<float> column(vectors.size());
  for (std::size_t i = 0; i < vectors.size(); ++i) column[i] = vectors[i][axis];
  return column;
}

std::vector<std::uint8_t> bytes_of(const Vectors& colors, int axis) {
  std::vector<std::uint8_t> column(colors.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const float value = std::min(std::max(colors[i][axis], 0.0F), 1.0F);
    column[i] = static_cast<std::uint8_t>(std::lround(255.0F * value));
  }
  return column;
}

}  // namespace

PointCloud point_cloud_from_ply(const Ply& ply) {
  const PlyElement& vertex = ply.element("vertex");
  PointCloud cloud;
  cloud.points = interleave(ply, {"x", "y", "z"});
  std::vector<bool> kept(cloud.size());
  for (std::size_t i = 0; i < cloud.size(); ++i) kept[i] = cloud.points[i].allFinite();
  const auto finite = static_cast<std::size_t>(std::count(kept.begin(), kept.end(), true));
  if (finite == 0) throw InputError(ply.file, "holds no point");
  if (finite < cloud.size()) {
    log_warning(ply.file + ": " + std::to_string(cloud.size() - finite) + " of " + std::to_string(cloud.size()) +
                " points are not finite and left out");
  }
  if (const auto names =
          first_complete(vertex, {Names{"red", "green", "blue"}, Names{"diffuse_red", "diffuse_green", "diffuse_blue"},
                                  Names{"r", "g", "b"}})) {
    cloud.colors = read_colors(ply, *names);
  }
  if (const auto names = first_complete(vertex, {Names{"nx", "ny", "nz"}})) {
    cloud.normals = read_normals(ply, *names, kept);
  }
  keep_only(kept, cloud.points);
  keep_only(kept, cloud.colors);
  keep_only(kept, cloud.normals);
  return cloud;
}

PointCloud read_point_cloud(const std::string& path) { return point_cloud_from_ply(read_ply(path)); }

void write_point_cloud(const std::string& path, const PointCloud& cloud) {
  PlyElement vertex;
  vertex.name = "vertex";
  const Names axes{"x", "y", "z"};
  const Names normal_axes{"nx", "ny", "nz"};
  const Names channels{"red", "green", "blue"};
  for (int a = 0; a < 3; ++a) vertex.add(axes[static_cast<std::size_t>(a)], axis_of(cloud.points, a));
  for (int a = 0; a < 3 && cloud.has_normals(); ++a) {
    vertex.add(normal_axes[static_cast<std::size_t>(a)], axis_of(cloud.normals, a));
  }
  for (int a = 0; a < 3 && cloud.has_colors(); ++a) {
    vertex.add(channels[static_cast<std::size_t>(a)], bytes_of(cloud.colors, a));
  }
  Ply ply;
  ply.comments = {"odosplat point cloud, metres"};
  ply.elements = {std::move(vertex)};
  write_ply(path, ply);
}

}  // namespace odosplat
