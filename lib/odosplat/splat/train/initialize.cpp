// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/initialize.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "odosplat/cloud/cloud_filters.hpp"
#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat {

namespace {

constexpr float lone_point_scale = 0.01F;  // [m] size of a point without neighbours
constexpr float smallest_scale = 0.05F;    // of the median size: points that coincide

/// `keep` of the points, chosen at random without replacement, in their old order.
PointCloud choose(const PointCloud& cloud, std::size_t keep, Random& random) {
  std::vector<std::uint32_t> order(cloud.size());
  std::iota(order.begin(), order.end(), 0U);
  for (std::size_t i = 0; i < keep; ++i)
    std::swap(order[i], order[i + random.below(static_cast<std::uint32_t>(order.size() - i))]);
  order.resize(keep);
  std::sort(order.begin(), order.end());
  PointCloud chosen;
  for (const std::uint32_t i : order) {
    chosen.points.push_back(cloud.points[i]);
    if (cloud.has_colors()) chosen.colors.push_back(cloud.colors[i]);
    if (cloud.has_normals()) chosen.normals.push_back(cloud.normals[i]);
  }
  return chosen;
}

void check_finite(const PointCloud& cloud) {
  for (std::size_t i = 0; i < cloud.size(); ++i)
    if (!cloud.points[i].allFinite()) throw InputError("cloud", "point " + std::to_string(i), "is not finite");
}

/// Size of every Gaussian [m], kept in a band around the median.
std::vector<float> sizes(const PointCloud& cloud, const InitializeOptions& options) {
  std::vector<float> size = mean_neighbor_distances(cloud, options.scale_neighbors);
  const float usual = upper_median(size);
  const float median = usual > 0.0F ? usual : lone_point_scale;
  for (float& s : size)
    s = options.scale_factor * std::clamp(s, smallest_scale * median, options.largest_scale * median);
  return size;
}

/// Points moved along their normals to the weighted mean of their neighbours. Weights fall with distance and with the
/// angle between normals; a neighbour further from the plane than half its distance along it lies on another surface.
std::vector<Eigen::Vector3f> smooth(const PointCloud& cloud, int neighbors) {
  const NeighborSearch search(cloud.points);
  std::vector<Eigen::Vector3f> smoothed(cloud.size());
  parallel_for(static_cast<int>(cloud.size()), 1024, [&](int begin, int end) {
    const auto k = static_cast<std::size_t>(neighbors) + 1;  // the point itself comes first
    std::vector<int> index(k);
    std::vector<float> squared(k);
    for (int i = begin; i < end; ++i) {
      const auto self = static_cast<std::size_t>(i);
      const Eigen::Vector3f& p = cloud.points[self];
      const Eigen::Vector3f& n = cloud.normals[self];
      const int found = search.nearest(p, neighbors + 1, index.data(), squared.data());
      const float reach = std::max(squared[static_cast<std::size_t>(found - 1)], 1e-12F);
      float sum = 0.0F;
      float weights = 0.0F;
      for (std::size_t j = 0; j < static_cast<std::size_t>(found); ++j) {
        const auto other = static_cast<std::size_t>(index[j]);
        const float agreement = std::abs(n.dot(cloud.normals[other]));
        const float height = n.dot(cloud.points[other] - p);
        if (agreement < 0.8F || height * height > 0.25F * reach) continue;
        const float weight = agreement * std::exp(-2.0F * squared[j] / reach);
        sum += weight * height;
        weights += weight;
      }
      smoothed[self] = p + (weights > 0.0F ? sum / weights : 0.0F) * n;
    }
  });
  return smoothed;
}

/// Uniform over rotations (Shoemake 1992).
Eigen::Quaternionf random_rotation(Random& random) {
  const double u = random.uniform();
  const double a = 2.0 * std::numbers::pi * random.uniform();
  const double b = 2.0 * std::numbers::pi * random.uniform();
  const Eigen::Quaterniond q(std::sqrt(u) * std::cos(b), std::sqrt(1.0 - u) * std::sin(a),
                             std::sqrt(1.0 - u) * std::cos(a), std::sqrt(u) * std::sin(b));
  return q.cast<float>();
}

}  // namespace

InitializeOptions InitializeOptions::preset(const std::string& name) {
  InitializeOptions options;
  if (name == "default") return options;
  if (name != "paper") throw InputError("preset", "must be default or paper, is \"" + name + "\"");
  options.shape = InitialShape::round;
  options.scale_factor = 1.0F;
  return options;
}

void InitializeOptions::check() const {
  require(sh_degree >= 0 && sh_degree <= 3, "sh_degree", "0..3");
  require(opacity > 0.0F && opacity < 1.0F, "opacity", "between 0 and 1");
  require(scale_neighbors >= 1, "scale_neighbors", "at least 1");
  require(scale_factor > 0.0F && std::isfinite(scale_factor), "scale_factor", "positive");
  require(flatness > 0.0F && flatness <= 1.0F, "flatness", "above 0, at most 1");
  require(largest_scale >= 1.0F, "largest_scale", "at least 1");
  require(normal_neighbors >= 3, "normal_neighbors", "at least 3");
  require(smoothing_neighbors >= 0, "smoothing_neighbors", "at least 0");
}

PointCloud smoothed_cloud(const PointCloud& input, const InitializeOptions& options) {
  options.check();
  if (input.size() == 0) throw InputError("cloud", "holds no points");
  check_finite(input);
  PointCloud cloud = input;
  const bool own_normals = cloud.has_normals();
  if (!own_normals) estimate_normals(cloud, options.normal_neighbors);
  if (options.smoothing_neighbors > 0) {
    cloud.points = smooth(cloud, options.smoothing_neighbors);
    if (!own_normals) estimate_normals(cloud, options.normal_neighbors);  // better ones, from better points
  }
  return cloud;
}

double noise_left(const PointCloud& cloud, const PointCloud& smoothed, const InitializeOptions& options) {
  require(cloud.size() == smoothed.size() && smoothed.has_normals(), "smoothed", "the cloud after smoothing");
  if (cloud.size() == 0 || options.smoothing_neighbors == 0) return 0.0;
  std::vector<float> moved(cloud.size());
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] = std::abs(smoothed.normals[i].dot(smoothed.points[i] - cloud.points[i]));
  // 1.4826: from the median absolute value of a normal distribution to its standard deviation. 0.76: share of the
  // neighbours that the weights of smooth() leave effective.
  return 1.4826 * static_cast<double>(upper_median(std::move(moved))) /
         std::sqrt(0.76 * (options.smoothing_neighbors + 1));
}

Gaussians gaussians_from_cloud(const PointCloud& input, const InitializeOptions& options) {
  options.check();
  if (input.size() == 0) throw InputError("cloud", "holds no points");
  check_finite(input);
  Random random(options.seed);
  PointCloud cloud =
      options.budget > 0 && options.budget < input.size() ? choose(input, options.budget, random) : input;
  const std::vector<float> size = sizes(cloud, options);
  if (options.shape == InitialShape::discs) cloud = smoothed_cloud(cloud, options);

  Gaussians gaussians;
  gaussians.sh_degree = options.sh_degree;
  gaussians.resize(cloud.size());
  const auto sh_stride = 3 * static_cast<std::size_t>(gaussians.coefficients());
  const float logit = std::log(options.opacity / (1.0F - options.opacity));
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    Eigen::Vector3f color = Eigen::Vector3f::Constant(0.5F);
    Eigen::Vector3f scale = Eigen::Vector3f::Constant(size[i]);
    Eigen::Quaternionf rotation = Eigen::Quaternionf::Identity();
    if (options.shape == InitialShape::discs) {
      rotation = Eigen::Quaternionf::FromTwoVectors(Eigen::Vector3f::UnitZ(), cloud.normals[i]).normalized();
      scale.z() *= options.flatness;
    } else {
      rotation = random_rotation(random);
      for (Eigen::Index c = 0; c < 3; ++c) color[c] = static_cast<float>(random.uniform());
    }
    if (cloud.has_colors()) color = cloud.colors[i];
    for (std::size_t a = 0; a < 3; ++a) {
      const auto axis = static_cast<Eigen::Index>(a);
      gaussians.positions[3 * i + a] = cloud.points[i][axis];
      gaussians.log_scales[3 * i + a] = std::log(scale[axis]);
      gaussians.sh[sh_stride * i + a] = (color[axis] - 0.5F) / sh_constant;
    }
    gaussians.rotations[4 * i] = rotation.w();
    gaussians.rotations[4 * i + 1] = rotation.x();
    gaussians.rotations[4 * i + 2] = rotation.y();
    gaussians.rotations[4 * i + 3] = rotation.z();
    gaussians.opacity_logits[i] = logit;
  }
  return gaussians;
}

}  // namespace odosplat
