// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/merge_layer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <unordered_map>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/edit/gaussian_shapes.hpp"

namespace odosplat {
namespace {

constexpr int merge_neighbors = 12;
constexpr int merge_chunk = 512;
constexpr float solid_opacity = 0.3F;
constexpr float same_direction = 0.7071F;  // cosine of 45 degrees
// Tangential distances, in spacings of the covering map. Between its Gaussians a place is at most about one spacing
// from the nearest; beyond their border, where all lie on one side, it counts as covered only closely.
constexpr float inside_spacings = 1.5F;
constexpr float border_spacings = 0.4F;
constexpr float one_sided = 0.6F;        // |mean tangential offset| over mean distance: 0.64 beside a half plane
constexpr float merged_spacings = 0.5F;  // this near anything counts, whatever the normals (edges, foliage, cables)

/// Offset from Gaussian j of `other` to p, along and across j's normal.
struct Offset {
  float along;
  Eigen::Vector3f across;
};
Offset offset_from(const MergeLayer& other, std::size_t j, const Eigen::Vector3f& p) {
  const Eigen::Vector3f d = p - other.points[j];
  const float along = other.normals[j].dot(d);
  return {along, d - along * other.normals[j]};
}

bool normals_agree(const MergeLayer& a, std::size_t i, const MergeLayer& b, std::size_t j) {
  if (a.flat[i] == 0 || b.flat[j] == 0) return true;
  return std::abs(a.normals[i].dot(b.normals[j])) >= same_direction;
}

/// The points of `layer` that a search is made of, and which they are.
struct Subset {
  std::vector<Eigen::Vector3f> points;
  std::vector<std::size_t> rows;
};
Subset solid_subset(const MergeLayer& layer, const std::vector<bool>& usable) {
  Subset subset;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (layer.solid[i] == 0 || !usable[i]) continue;
    subset.points.push_back(layer.points[i]);
    subset.rows.push_back(i);
  }
  return subset;
}

int facing(const Eigen::Vector3f& normal) {
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return axis;
}

bool is_surface(const MergeLayer& layer, std::size_t i) { return layer.solid[i] != 0 && layer.flat[i] != 0; }

Eigen::AlignedBox3f bounds_of_surfaces(const MergeLayer& layer) {
  Eigen::AlignedBox3f bounds;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (is_surface(layer, i)) bounds.extend(layer.points[i]);
  }
  return bounds;
}

/// Of a layer's surfaces in a box, by the axis that they face.
struct Facing {
  std::array<std::size_t, 3> all{};
  std::array<std::size_t, 3> paired{};
};
template <typename IsPaired>
Facing count_facing(const MergeLayer& layer, const Eigen::AlignedBox3f& box, const IsPaired& is_paired) {
  Facing counts;
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (!is_surface(layer, i) || !box.contains(layer.points[i])) continue;
    const auto axis = static_cast<std::size_t>(facing(layer.normals[i]));
    ++counts.all[axis];
    if (is_paired(i)) ++counts.paired[axis];
  }
  return counts;
}

bool is_covered(const MergeLayer& layer, std::size_t i, const MergeLayer& other, const Subset& subset,
                const NeighborSearch& search, const MergeOptions& options) {
  std::array<int, merge_neighbors> near{};
  std::array<float, merge_neighbors> squared{};
  const int found = search.nearest(layer.points[i], merge_neighbors, near.data(), squared.data());
  const float reach = std::max(inside_spacings, merged_spacings);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  float distances = 0.0F;
  float nearest = std::numeric_limits<float>::infinity();  // tangential, in spacings
  int agreeing = 0;
  for (int k = 0; k < found; ++k) {
    const std::size_t j = subset.rows[static_cast<std::size_t>(near[static_cast<std::size_t>(k)])];
    const float spacing = other.spacings[j];
    if (std::sqrt(squared[static_cast<std::size_t>(k)]) <= merged_spacings * std::min(spacing, layer.spacings[i]))
      return true;
    if (!normals_agree(layer, i, other, j)) continue;
    const Offset offset = offset_from(other, j, layer.points[i]);
    const auto apart =
        static_cast<float>(options.sigmas * std::hypot(static_cast<double>(layer.sigmas[i]), double{other.sigmas[j]}));
    const auto unresolved = static_cast<float>(options.spacings) * std::max(spacing, layer.spacings[i]);
    if (std::abs(offset.along) > std::max(apart, unresolved)) continue;
    const float across = offset.across.norm();
    sum += offset.across;
    distances += across;
    ++agreeing;
    if (spacing > 0.0F) nearest = std::min(nearest, across / spacing);
  }
  if (agreeing == 0 || !(nearest <= reach)) return false;
  const bool beside = agreeing < 3 || sum.norm() > one_sided * distances;
  return nearest <= (beside ? border_spacings : inside_spacings);
}

}  // namespace

void MergeLayer::append(const MergeLayer& other, const std::vector<bool>& keep) {
  for (std::size_t i = 0; i < other.size(); ++i) {
    if (!keep[i]) continue;
    points.push_back(other.points[i]);
    normals.push_back(other.normals[i]);
    spacings.push_back(other.spacings[i]);
    sigmas.push_back(other.sigmas[i]);
    gray.push_back(other.gray[i]);
    flat.push_back(other.flat[i]);
    solid.push_back(other.solid[i]);
  }
}

namespace {

/// Normals of all: those of flat Gaussians are their own, of the others that of the plane through the nearest centres.
std::vector<Eigen::Vector3f> surface_normals(const GaussianShapes& shapes) {
  constexpr int neighbors = 12;
  std::vector<Eigen::Vector3f> normals = shapes.cloud.normals;
  if (std::all_of(shapes.flat.begin(), shapes.flat.end(), [](char flat) { return flat != 0; })) return normals;
  PointCloud fitted;
  fitted.points = shapes.cloud.points;
  estimate_normals(fitted, neighbors);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (shapes.flat[i] == 0) normals[i] = fitted.normals[i];
  }
  return normals;
}

}  // namespace

MergeLayer merge_layer(const Map& map) {
  const GaussianShapes shapes = gaussian_shapes(map.gaussians);
  MergeLayer layer;
  layer.points = shapes.cloud.points;
  layer.normals = surface_normals(shapes);
  layer.spacings = shapes.spacings;
  layer.flat = shapes.flat;
  std::vector<Eigen::Vector3f> cameras;
  for (const SE3& T_world_camera : map.header.places) cameras.push_back(T_world_camera.translation().cast<float>());
  const NeighborSearch search(cameras);
  const float share = map.header.sigma.value_or(SigmaModel()).depth_share;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    int index = 0;
    float squared = 0.0F;
    const bool known = search.nearest(layer.points[i], 1, &index, &squared) > 0;
    const float of_depth = known ? share * std::sqrt(squared) : 0.1F * layer.spacings[i];
    // A thick Gaussian is a poor surface, but not one that may be mistaken for any other.
    layer.sigmas.push_back(std::hypot(of_depth, std::min(shapes.thickness[i], 0.25F * layer.spacings[i])));
    layer.gray.push_back(shapes.cloud.colors[i].dot(Eigen::Vector3f(0.299F, 0.587F, 0.114F)));
    layer.solid.push_back(shapes.opacities[i] >= solid_opacity ? 1 : 0);
  }
  return layer;
}

std::vector<bool> covered(const MergeLayer& layer, const MergeLayer& other, const std::vector<bool>& usable,
                          const MergeOptions& options) {
  const Subset subset = solid_subset(other, usable);
  if (subset.rows.empty()) return std::vector<bool>(layer.size(), false);
  const NeighborSearch search(subset.points);
  std::vector<char> found(layer.size(), 0);  // bits of vector<bool> cannot be written by several threads
  parallel_for(static_cast<int>(layer.size()), merge_chunk, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      found[i] = is_covered(layer, i, other, subset, search, options) ? 1 : 0;
    }
  });
  return {found.begin(), found.end()};
}

MergeOverlap compare_surfaces(const MergeLayer& layer, const MergeLayer& other) {
  constexpr float search_sigmas = 30.0F;
  constexpr float search_spacings = 3.0F;
  constexpr float parallel = 0.866F;  // cosine of 30 degrees
  constexpr std::size_t least_pairs = 100;
  constexpr double least_share = 0.05;
  struct Pair {
    int axis = -1;  // none: no partner
    float distance = 0.0F;
    float sigmas = 0.0F;
    float gray = 0.0F;
  };
  MergeOverlap overlap;
  const Subset subset = solid_subset(other, std::vector<bool>(other.size(), true));
  if (subset.rows.empty()) return overlap;
  const NeighborSearch search(subset.points);
  std::vector<Pair> pairs(layer.size());
  parallel_for(static_cast<int>(layer.size()), merge_chunk, [&](int begin, int end) {
    std::array<int, merge_neighbors> near{};
    std::array<float, merge_neighbors> squared{};
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
      if (!is_surface(layer, i)) continue;
      const int found = search.nearest(layer.points[i], merge_neighbors, near.data(), squared.data());
      float least_across = std::numeric_limits<float>::infinity();
      for (int k = 0; k < found; ++k) {
        const std::size_t j = subset.rows[static_cast<std::size_t>(near[static_cast<std::size_t>(k)])];
        if (other.flat[j] == 0 || std::abs(layer.normals[i].dot(other.normals[j])) < parallel) continue;
        const Offset offset = offset_from(other, j, layer.points[i]);
        const float sigma = std::hypot(layer.sigmas[i], other.sigmas[j]);
        const float across = offset.across.norm();
        const float distance = std::abs(offset.along);
        if (across > other.spacings[j] || across >= least_across || !(sigma > 0.0F) ||
            distance > std::max(search_sigmas * sigma, search_spacings * other.spacings[j]))
          continue;
        least_across = across;
        pairs[i] = {facing(other.normals[j]), distance, distance / sigma, layer.gray[i] - other.gray[j]};
      }
    }
  });
  std::vector<float> gray;
  for (const Pair& pair : pairs) {
    if (pair.axis >= 0) gray.push_back(pair.gray);
  }
  overlap.pairs = gray.size();
  overlap.gray = static_cast<double>(upper_median(std::move(gray)));
  // Per axis: walls hide a shift along themselves, so that the median over all would not show it.
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<float> distances;
    std::vector<float> sigmas;
    for (const Pair& pair : pairs) {
      if (pair.axis != axis) continue;
      distances.push_back(pair.distance);
      sigmas.push_back(pair.sigmas);
    }
    const std::size_t count = sigmas.size();
    if (count < least_pairs || static_cast<double>(count) < least_share * static_cast<double>(overlap.pairs)) continue;
    const auto median = static_cast<double>(upper_median(std::move(sigmas)));
    if (median <= overlap.sigmas) continue;
    overlap.sigmas = median;
    overlap.distance_m = static_cast<double>(upper_median(std::move(distances)));
  }
  // A shift beyond the reach of the search leaves walls without partners, but floor and ceiling meet.
  const Eigen::AlignedBox3f box = bounds_of_surfaces(layer).intersection(bounds_of_surfaces(other));
  const Facing mine = count_facing(layer, box, [&](std::size_t i) { return pairs[i].axis >= 0; });
  const Facing theirs = count_facing(other, box, [](std::size_t) { return false; });
  for (std::size_t axis = 0; axis < 3; ++axis) {
    overlap.unmet[axis] = std::min(mine.all[axis], theirs.all[axis]) >= least_pairs &&
                          static_cast<double>(mine.paired[axis]) < least_share * static_cast<double>(mine.all[axis]);
  }
  return overlap;
}

MergePatches merge_patches(const MergeLayer& a, const MergeLayer& b, double radius) {
  using Cell = std::array<std::int64_t, 3>;
  struct Hash {
    std::size_t operator()(const Cell& c) const {
      return static_cast<std::size_t>(c[0] * 73856093 ^ c[1] * 19349663 ^ c[2] * 83492791);
    }
  };
  std::vector<Eigen::Vector3f> centres;
  std::unordered_map<Cell, std::vector<int>, Hash> cells;
  const auto add = [&](const Eigen::Vector3f& p) {
    Cell cell{};
    for (std::size_t k = 0; k < 3; ++k) {
      cell[k] = static_cast<std::int64_t>(std::floor(static_cast<double>(p[static_cast<Eigen::Index>(k)]) / radius));
    }
    for (std::int64_t x = -1; x <= 1; ++x) {
      for (std::int64_t y = -1; y <= 1; ++y) {
        for (std::int64_t z = -1; z <= 1; ++z) {
          const auto found = cells.find({cell[0] + x, cell[1] + y, cell[2] + z});
          if (found == cells.end()) continue;
          for (const int other : found->second) {
            if (static_cast<double>((centres[static_cast<std::size_t>(other)] - p).norm()) < radius) return;
          }
        }
      }
    }
    cells[cell].push_back(static_cast<int>(centres.size()));
    centres.push_back(p);
  };
  for (const Eigen::Vector3f& p : a.points) add(p);
  for (const Eigen::Vector3f& p : b.points) add(p);
  const NeighborSearch search(centres);
  const auto nearest = [&](const std::vector<Eigen::Vector3f>& points) {
    std::vector<int> patches(points.size());
    parallel_for(static_cast<int>(points.size()), merge_chunk, [&](int begin, int end) {
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        float squared = 0.0F;
        search.nearest(points[i], 1, &patches[i], &squared);
      }
    });
    return patches;
  };
  return {nearest(a.points), nearest(b.points), centres.size()};
}

}  // namespace odosplat
