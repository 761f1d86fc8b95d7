// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/floaters.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/edit/edited_header.hpp"
#include "odosplat/splat/edit/gaussian_shapes.hpp"
#include "odosplat/splat/kept_gaussians.hpp"

namespace odosplat {
namespace {

constexpr int floater_chunk = 512;
constexpr std::size_t around = 16;  // neighbours whose spacing is that of the surface there
constexpr std::size_t linked = 8;   // neighbours that a Gaussian may be in a group with

/// For every point its nearest others, nearest first.
class Neighborhood {
 public:
  explicit Neighborhood(const std::vector<Eigen::Vector3f>& points)
      : count_(std::min(around, points.empty() ? 0 : points.size() - 1)),
        indices_(points.size() * count_),
        distances_(points.size() * count_) {
    const NeighborSearch search(points);
    parallel_for(static_cast<int>(points.size()), floater_chunk, [&](int begin, int end) {
      std::array<int, around + 1> near{};
      std::array<float, around + 1> squared{};
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        const int found = search.nearest(points[i], static_cast<int>(count_) + 1, near.data(), squared.data());
        std::size_t kept = 0;
        for (std::size_t k = 0; k < static_cast<std::size_t>(found) && kept < count_; ++k) {
          if (near[k] == static_cast<int>(i)) continue;
          indices_[i * count_ + kept] = near[k];
          distances_[i * count_ + kept++] = std::sqrt(squared[k]);
        }
      }
    });
  }
  std::size_t count() const { return count_; }
  std::size_t index(std::size_t i, std::size_t k) const { return static_cast<std::size_t>(indices_[i * count_ + k]); }
  float distance(std::size_t i, std::size_t k) const { return distances_[i * count_ + k]; }

 private:
  std::size_t count_;
  std::vector<int> indices_;
  std::vector<float> distances_;
};

/// Spacing of the surface around every point: the median of the neighbours' spacings.
std::vector<float> surface_spacings(const Neighborhood& near, const std::vector<float>& spacings) {
  std::vector<float> surface(spacings.size());
  for (std::size_t i = 0; i < surface.size(); ++i) {
    std::vector<float> values;
    for (std::size_t k = 0; k < near.count(); ++k) values.push_back(spacings[near.index(i, k)]);
    surface[i] = upper_median(std::move(values), spacings[i]);
  }
  return surface;
}

/// Whether an end of its longest axis, two standard deviations from the centre, has no other Gaussian around it.
bool sticks_out(const GaussianShapes& shapes, const Eigen::Vector3f& axis, std::size_t i, float reach,
                const NeighborSearch& search) {
  for (const float side : {-2.0F, 2.0F}) {
    const Eigen::Vector3f end = shapes.cloud.points[i] + side * shapes.length[i] * axis;
    std::array<int, 2> near{};
    std::array<float, 2> squared{};
    const int found = search.nearest(end, 2, near.data(), squared.data());
    const std::size_t other = found > 1 && near[0] == static_cast<int>(i) ? 1 : 0;
    if (std::sqrt(squared[other]) > reach) return true;
  }
  return false;
}

/// Groups of points that are joined by links; find() gives one member that stands for the group.
class Groups {
 public:
  explicit Groups(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::size_t i, std::size_t j) {
    const std::size_t a = find(i);
    const std::size_t b = find(j);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

/// Whether the points nearest to point i lie in a plane, in which i lies too, with its Gaussian's plane, if that is
/// flat.
bool in_a_plane(const GaussianShapes& shapes, std::size_t i, const Neighborhood& near) {
  constexpr float most_rms = 0.08F;  // of the mean distance; eight points at random in space have about 0.3
  constexpr float most_off = 0.25F;  // likewise, of i from the plane
  constexpr float same_normal = 0.9F;
  const std::size_t n = std::min(linked, near.count());
  if (n < 4) return false;
  Eigen::Vector3f mean = Eigen::Vector3f::Zero();
  float distance = 0.0F;
  for (std::size_t k = 0; k < n; ++k) {
    mean += shapes.cloud.points[near.index(i, k)];
    distance += near.distance(i, k);
  }
  mean /= static_cast<float>(n);
  distance /= static_cast<float>(n);
  Eigen::Matrix3f scatter = Eigen::Matrix3f::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    const Eigen::Vector3f d = shapes.cloud.points[near.index(i, k)] - mean;
    scatter += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver(scatter / static_cast<float>(n));
  const Eigen::Vector3f normal = solver.eigenvectors().col(0);
  if (std::sqrt(std::max(solver.eigenvalues()[0], 0.0F)) > most_rms * distance) return false;
  if (std::abs(normal.dot(shapes.cloud.points[i] - mean)) > most_off * distance) return false;
  return shapes.flat[i] == 0 || std::abs(normal.dot(shapes.cloud.normals[i])) >= same_normal;
}

void mark_isolated(const GaussianShapes& shapes, const FloaterOptions& options, std::vector<Floater>& floaters) {
  GaussianShapes rest;  // without those that are floating anyway and would link others
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (floaters[i] != Floater::none) continue;
    rows.push_back(i);
    rest.cloud.points.push_back(shapes.cloud.points[i]);
    rest.cloud.normals.push_back(shapes.cloud.normals[i]);
    rest.flat.push_back(shapes.flat[i]);
    rest.spacings.push_back(shapes.spacings[i]);
  }
  const Neighborhood near(rest.cloud.points);
  const std::vector<float> surface = surface_spacings(near, rest.spacings);
  const float middle = upper_median(rest.spacings);
  Groups groups(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const float reach = static_cast<float>(options.apart_spacings) * std::min(surface[i], middle);
    for (std::size_t k = 0; k < std::min(linked, near.count()); ++k) {
      if (near.distance(i, k) <= reach) groups.join(i, near.index(i, k));
    }
  }
  std::vector<std::size_t> sizes(rows.size(), 0);
  for (std::size_t i = 0; i < rows.size(); ++i) ++sizes[groups.find(i)];
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (sizes[groups.find(i)] >= options.least_group || in_a_plane(rest, i, near)) continue;
    floaters[rows[i]] = Floater::isolated;
  }
}

}  // namespace

const std::array<const char*, 5> floater_words{"kept", "almost transparent", "huge", "isolated", "in free space"};

void FloaterOptions::check() const {
  require(least_opacity >= 0.0F && least_opacity <= 1.0F, "least_opacity", "in 0..1");
  require(huge_spacings > 0.0, "huge_spacings", "positive");
  require(apart_spacings > 0.0, "apart_spacings", "positive");
  require(free_spacings >= 0.0, "free_spacings", "at least 0");
  require(free_share >= 0.0, "free_share", "at least 0");
  require(least_views >= 1, "least_views", "at least 1");
  require(views_for_one >= 0.0, "views_for_one", "at least 0");
}

std::vector<Floater> find_floaters(const Gaussians& gaussians, const FloaterOptions& options) {
  options.check();
  const GaussianShapes shapes = gaussian_shapes(gaussians);
  std::vector<Floater> floaters(shapes.size(), Floater::none);
  if (shapes.size() < 2) return floaters;
  const Neighborhood near(shapes.cloud.points);
  const std::vector<float> surface = surface_spacings(near, shapes.spacings);
  const NeighborSearch search(shapes.cloud.points);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes.opacities[i] < options.least_opacity) {
      floaters[i] = Floater::transparent;
    } else if (static_cast<double>(shapes.length[i]) > options.huge_spacings * static_cast<double>(surface[i]) &&
               sticks_out(shapes, longest_axis(gaussians, i), i,
                          static_cast<float>(options.apart_spacings) * surface[i], search)) {
      floaters[i] = Floater::huge;
    }
  }
  mark_isolated(shapes, options, floaters);
  return floaters;
}

std::array<std::size_t, 5> count_floaters(const std::vector<Floater>& floaters) {
  std::array<std::size_t, 5> counts{};
  for (const Floater floater : floaters) ++counts[static_cast<std::size_t>(floater)];
  return counts;
}

Map without_floaters(const Map& map, const std::vector<Floater>& floaters) {
  require(floaters.size() == map.gaussians.size(), "floaters", "one per Gaussian");
  const std::array<std::size_t, 5> counts = count_floaters(floaters);
  if (counts[0] == 0) throw InputError("clean", "nothing would be left: all Gaussians count as floating");
  std::vector<bool> keep(floaters.size());
  for (std::size_t i = 0; i < keep.size(); ++i) keep[i] = floaters[i] == Floater::none;
  std::string words = "clean:";
  for (std::size_t k = 1; k < counts.size(); ++k) {
    words += (k > 1 ? ", " : " ") + std::to_string(counts[k]) + " " + floater_words[k];
  }
  words += " of " + std::to_string(floaters.size()) + " Gaussians removed";
  return {kept_gaussians(map.gaussians, keep), with_edit(map.header, words)};
}

}  // namespace odosplat
