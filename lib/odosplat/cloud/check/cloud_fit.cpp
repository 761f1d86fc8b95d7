// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/cloud_fit.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <optional>

#include "odosplat/cloud/check/visible_patches.hpp"
#include "odosplat/core/angles.hpp"
#include "odosplat/core/pair_scores.hpp"
#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

constexpr int unknowns = 8;  // shift, rotation, ln scale, ln focal length
constexpr int groups = 8;
constexpr std::size_t least_matches = 40;    // per pair
constexpr double patch_search_radius = 6.0;  // [px] search radius for a patch
constexpr double least_share = 0.1;          // share of the patches that must be found
constexpr double clear_texture = 0.02;  // directions with a smaller eigenvalue of a match's information are not used
constexpr double least_spread = 0.05;   // [px] lower limit for the spread of the matches
constexpr double prior_turn = 0.2;
constexpr double prior_scale = 0.2;
constexpr double prior_share = 0.5;  // of the median depth
constexpr double fit_step = 1e-4;    // of numeric derivatives
// Floors of the sigmas: errors due to poses, shutter and lens, which more patches do not reduce.
constexpr double floor_scale = 0.002;
constexpr double floor_offset = 0.002;  // of the median depth
constexpr double floor_turn_deg = 0.1;

using Vector8d = Eigen::Matrix<double, unknowns, 1>;
using Matrix8d = Eigen::Matrix<double, unknowns, unknowns>;
using Row8d = Eigen::Matrix<double, 1, unknowns>;

// The fit so far.
struct State {
  Similarity world_from_cloud;
  double focal = 1.0;  // factor
};

Camera scaled(Camera camera, double factor) {
  camera.fx *= factor;
  camera.fy *= factor;
  return camera;
}

struct Pair {
  std::size_t from = 0;
  std::size_t to = 0;
};

std::vector<Pair> pairs_of(const CloudFitInput& input, int gap, int wanted) {
  const auto distance = static_cast<std::size_t>(gap);
  if (input.images.size() <= distance) return {};
  const std::size_t possible = input.images.size() - distance;
  const std::size_t count = std::min(possible, static_cast<std::size_t>(wanted));
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < count; ++k) pairs.push_back({k * possible / count, k * possible / count + distance});
  return pairs;
}

// The equation of one direction of a match: the distance between expected and found position, and its derivatives by
// the unknowns.
struct Equation {
  Row8d row = Row8d::Zero();
  double distance = 0.0;  // [px]
};

struct Measurement {
  std::vector<Equation> equations;
  std::size_t matches = 0;
  std::vector<double> depths;  // [m]
  std::size_t patches = 0;
};

// Position in the image `to` of the surface point at the patch's pixel in `from`, with the patch's plane moved by the
// unknowns about `middle`.
Eigen::Vector2d predict(const Vector8d& t, const VisiblePatch& patch, const Eigen::Vector3d& p_world,
                        const Eigen::Vector3d& n_world, const Eigen::Vector3d& middle, const Camera& camera,
                        const SE3& T_world_from, const SE3& T_world_to) {
  const Camera changed = scaled(camera, std::exp(t[7]));
  const Eigen::Quaterniond turn = so3_exp(t.segment<3>(3));
  const Eigen::Vector3d p = middle + t.head<3>() + std::exp(t[6]) * (turn * (p_world - middle));
  const Eigen::Vector3d n = turn * n_world;
  const Eigen::Vector3d ray = T_world_from.rotation() * changed.ray(patch.x, patch.y);
  const Eigen::Vector3d& eye = T_world_from.translation();
  const double depth = n.dot(p - eye) / n.dot(ray);
  return changed.project(T_world_to.inverse() * (eye + depth * ray));
}

Measurement measure(const CloudFitInput& input, const PointCloud& cloud, const std::vector<float>& spacings,
                    const State& state, const Eigen::Vector3d& middle, const Pair& pair, int wanted) {
  const Camera camera = scaled(input.camera, state.focal);
  const SE3& T_world_from = input.T_world_camera[pair.from];
  const SE3& T_world_to = input.T_world_camera[pair.to];
  const SE3 T_to_from = T_world_to.inverse() * T_world_from;
  const GrayImage from = input.gray(input.images[pair.from]);
  const GrayImage to = input.gray(input.images[pair.to]);
  const std::vector<VisiblePatch> patches = visible_patches(cloud, spacings, from, camera, T_world_from, wanted);
  std::vector<std::optional<PatchMatch>> matches(patches.size());
  parallel_for(static_cast<int>(patches.size()), 32, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto at = static_cast<std::size_t>(i);
      matches[at] = match_patch(patches[at], from, to, camera, T_to_from, patch_search_radius);
    }
  });
  Measurement result;
  result.patches = patches.size();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (!matches[i]) continue;
    const VisiblePatch& patch = patches[i];
    const PatchMatch& match = *matches[i];
    const auto at = static_cast<std::size_t>(patch.index);
    const Eigen::Vector3d n = cloud.normals[at].cast<double>();
    const Eigen::Vector3d ray = T_world_from.rotation() * camera.ray(patch.x, patch.y);
    // The patch's plane is tilted where it is seen edge-on, so the point's normal is not valid there.
    if (std::abs(n.dot(ray.normalized())) < 0.15) continue;
    const Eigen::Vector3d p = T_world_from.translation() + ray / static_cast<double>(patch.inverse_depth);
    Eigen::Matrix<double, 2, unknowns> J;
    for (int k = 0; k < unknowns; ++k) {
      const Vector8d d = fit_step * Vector8d::Unit(k);
      J.col(k) = (predict(d, patch, p, n, middle, camera, T_world_from, T_world_to) -
                  predict(-d, patch, p, n, middle, camera, T_world_from, T_world_to)) /
                 (2.0 * fit_step);
    }
    if (!J.allFinite()) continue;
    const Eigen::Vector2d away = match.found - match.predicted;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> texture(match.information);
    for (int k = 0; k < 2; ++k) {
      if (texture.eigenvalues()[k] < clear_texture) continue;
      const Eigen::Vector2d direction = texture.eigenvectors().col(k);
      result.equations.push_back({direction.transpose() * J, direction.dot(away)});
    }
    ++result.matches;
    result.depths.push_back(1.0 / static_cast<double>(patch.inverse_depth));
  }
  const bool enough = result.matches >= least_matches &&
                      static_cast<double>(result.matches) >= least_share * static_cast<double>(result.patches);
  if (!enough) return {};
  return result;
}

struct Normals {
  Matrix8d matrix = Matrix8d::Zero();
  Vector8d vector = Vector8d::Zero();
};

// The normal equations of each group, in units of the matches' spread.
std::vector<Normals> normal_equations(const std::vector<Measurement>& measurements, const Vector8d& around,
                                      double& spread) {
  std::vector<double> sizes;
  for (const Measurement& m : measurements) {
    for (const Equation& e : m.equations) sizes.push_back(std::abs(e.distance - e.row.dot(around)));
  }
  spread = std::max(least_spread, 1.4826 * median_of(std::move(sizes)));
  const double limit = 4.685 * spread;
  std::vector<Normals> normals(groups);
  for (std::size_t m = 0; m < measurements.size(); ++m) {
    Normals& into = normals[m * groups / measurements.size()];
    for (const Equation& e : measurements[m].equations) {
      const double r = (e.distance - e.row.dot(around)) / limit;
      if (std::abs(r) >= 1.0) continue;
      const double weight = (1.0 - r * r) * (1.0 - r * r) / (spread * spread);
      into.matrix += weight * e.row.transpose() * e.row;
      into.vector += weight * e.distance * e.row.transpose();
    }
  }
  return normals;
}

struct Solution {
  Vector8d value = Vector8d::Zero();
  Matrix8d covariance = Matrix8d::Zero();
  std::vector<Vector8d> without;  // jackknife: solutions without one group each
};

// prior: information about the unknowns, centred on their initial values, from which they have moved by `so_far`.
Solution solve(const std::vector<Measurement>& measurements, const Vector8d& prior, const Vector8d& so_far) {
  Solution solution;
  std::vector<Normals> normals;
  Matrix8d all;
  Vector8d right;
  for (int iteration = 0; iteration < 10; ++iteration) {
    double spread = 0.0;
    normals = normal_equations(measurements, solution.value, spread);
    all = prior.asDiagonal();
    right = -prior.cwiseProduct(so_far);
    for (const Normals& n : normals) {
      all += n.matrix;
      right += n.vector;
    }
    solution.value = all.ldlt().solve(right);
  }
  solution.covariance = all.ldlt().solve(Matrix8d::Identity());
  for (const Normals& n : normals) {
    if (n.matrix.isZero(0.0)) continue;
    solution.without.emplace_back((all - n.matrix).ldlt().solve(right - n.vector));
  }
  return solution;
}

State apply(const State& state, const Vector8d& change, const Eigen::Vector3d& middle) {
  const double scale = std::exp(change[6]);
  const Eigen::Quaterniond turn = so3_exp(change.segment<3>(3));
  // p -> middle + shift + scale * R * (p - middle), applied after the previous similarity.
  const Similarity& old = state.world_from_cloud;
  const Eigen::Vector3d t = middle + change.head<3>() + scale * (turn * (old.T_target_source.translation() - middle));
  return {{scale * old.scale, SE3(turn * old.T_target_source.rotation(), t)}, state.focal * std::exp(change[7])};
}

// The whole state as a single step from the cloud's initial place.
Vector8d total_of(const State& state, const Eigen::Vector3d& middle) {
  Vector8d total;
  const Similarity& s = state.world_from_cloud;
  total << s * middle - middle, so3_log(s.T_target_source.rotation()), std::log(s.scale), std::log(state.focal);
  return total;
}

Eigen::Vector3d middle_of(const CloudFitInput& input, const std::vector<Measurement>& measurements,
                          const std::vector<Pair>& pairs, double& depth) {
  std::vector<double> depths;
  std::vector<double> axes[3];
  for (std::size_t m = 0; m < measurements.size(); ++m) {
    if (measurements[m].equations.empty()) continue;
    depths.insert(depths.end(), measurements[m].depths.begin(), measurements[m].depths.end());
    const double z = median_of(measurements[m].depths);
    const Eigen::Vector3d p = input.T_world_camera[pairs[m].from] * Eigen::Vector3d(0.0, 0.0, z);
    for (int a = 0; a < 3; ++a) axes[a].push_back(p[a]);
  }
  depth = median_of(std::move(depths));
  return {median_of(axes[0]), median_of(axes[1]), median_of(axes[2])};
}

// Median residual [px] with the unknowns at `t`.
double median_distance(const std::vector<Measurement>& measurements, const Vector8d& t) {
  std::vector<double> distances;
  for (const Measurement& m : measurements) {
    for (const Equation& e : m.equations) distances.push_back(std::abs(e.distance - e.row.dot(t)));
  }
  return median_of(std::move(distances));
}

// The length of a vector and its sigma along the vector; the largest sigma of any direction if the length is below it.
Measured length_of(const Eigen::Vector3d& value, const Eigen::Matrix3d& covariance, double floor,
                   const std::vector<Eigen::Vector3d>& without) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  const double n = static_cast<double>(without.size());
  for (const Eigen::Vector3d& v : without) mean += v / n;
  for (const Eigen::Vector3d& v : without) spread += (n - 1.0) / n * (v - mean) * (v - mean).transpose();
  const auto largest = [](const Eigen::Matrix3d& m) {
    return std::sqrt(std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(m).eigenvalues()[2]));
  };
  const double length = value.norm();
  const double worst = std::max(largest(covariance), largest(spread));
  if (length < worst) return {length, std::hypot(floor, worst)};
  const Eigen::Vector3d along = value / length;
  const double variance = std::max(along.dot(covariance * along), along.dot(spread * along));
  return {length, std::hypot(floor, std::sqrt(variance))};
}

}  // namespace

PointCloud moved(const PointCloud& cloud, const Similarity& similarity) {
  PointCloud result;
  const Eigen::Matrix3f R = similarity.T_target_source.rotation_matrix().cast<float>();
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    result.points.push_back((similarity * cloud.points[i].cast<double>()).cast<float>());
    result.normals.push_back(R * cloud.normals[i]);
  }
  return result;
}

CloudFit fit_cloud(const CloudFitInput& input, const CloudFitOptions& options) {
  CloudFit fit;
  State state;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Vector8d prior = Vector8d::Zero();
  Vector8d so_far = Vector8d::Zero();
  Vector8d last = Vector8d::Zero();
  Solution solution;
  // From short to long gaps: the nearer the two cameras, the smaller the shift that an error of the cloud causes, so
  // that patches are still found within the search radius.
  const std::vector<std::vector<int>> stages{{1, 2}, {1, 2}, {2, 4}, {1, 2, 4, 8}, {1, 2, 4, 8}, {1, 2, 4, 8}};
  bool first = true;
  double done = 0.0;
  for (const std::vector<int>& stage : stages) {
    if (input.progress) input.progress(done++ / static_cast<double>(stages.size()));
    const PointCloud cloud = moved(*input.cloud, state.world_from_cloud);
    std::vector<float> spacings = *input.spacings;
    for (float& s : spacings) s *= static_cast<float>(state.world_from_cloud.scale);
    std::vector<Pair> pairs;
    for (const int halves : stage) {
      const std::vector<Pair> more = pairs_of(input, std::max(1, options.gap * halves / 2), options.pairs);
      pairs.insert(pairs.end(), more.begin(), more.end());
    }
    std::stable_sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) { return a.from < b.from; });
    std::vector<Measurement> measurements;
    std::vector<Pair> used;
    for (const Pair& pair : pairs) {
      Measurement m = measure(input, cloud, spacings, state, middle, pair, options.patches);
      if (m.equations.empty()) continue;
      measurements.push_back(std::move(m));
      used.push_back(pair);
    }
    if (measurements.empty()) break;
    if (first) {
      first = false;
      middle = middle_of(input, measurements, used, fit.median_depth_m);
      const double shift = prior_share * fit.median_depth_m;
      prior << Eigen::Vector3d::Constant(1.0 / (shift * shift)),
          Eigen::Vector3d::Constant(1.0 / (prior_turn * prior_turn)), 1.0 / (prior_scale * prior_scale),
          1.0 / (prior_scale * prior_scale);
      continue;  // the derivatives were computed about another middle
    }
    fit.patches = 0;
    for (const Measurement& m : measurements) fit.patches += static_cast<int>(m.matches);
    solution = solve(measurements, prior, so_far);
    fit.error_before_px = median_distance(measurements, -so_far);
    fit.error_after_px = median_distance(measurements, solution.value);
    state = apply(state, solution.value, middle);
    const Vector8d before = so_far;
    so_far = total_of(state, middle);
    last = so_far - before;
  }
  if (fit.patches == 0) return fit;

  std::vector<double> scales;
  std::vector<double> focals;
  std::vector<Eigen::Vector3d> offsets;
  std::vector<Eigen::Vector3d> turns;
  std::vector<Eigen::Vector3d> origins;
  // The world's origin moves by shift + (1 - s R) middle.
  const auto origin_of = [&](const Vector8d& total) -> Eigen::Vector3d {
    return middle + total.head<3>() - std::exp(total[6]) * (so3_exp(total.segment<3>(3)) * middle);
  };
  for (const Vector8d& v : solution.without) {
    const Vector8d total = so_far - last + v;
    scales.push_back(std::exp(total[6]));
    focals.push_back(input.camera.fx * std::exp(total[7]));
    offsets.emplace_back(total.head<3>());
    turns.emplace_back(degrees_per_radian * total.segment<3>(3));
    origins.push_back(origin_of(total));
  }
  Eigen::Matrix<double, 3, unknowns> origin_slope;
  for (int k = 0; k < unknowns; ++k) {
    const Vector8d d = fit_step * Vector8d::Unit(k);
    origin_slope.col(k) = (origin_of(so_far + d) - origin_of(so_far - d)) / (2.0 * fit_step);
  }
  const Matrix8d& covariance = solution.covariance;
  fit.world_from_cloud = state.world_from_cloud;
  fit.offset = so_far.head<3>();
  fit.scale = with_sigma(state.world_from_cloud.scale, std::sqrt(covariance(6, 6)), floor_scale, scales);
  const double fx = input.camera.fx;
  const double floor_m = floor_offset * fit.median_depth_m;
  fit.focal_px = with_sigma(fx * state.focal, fx * std::sqrt(covariance(7, 7)), floor_scale * fx, focals);
  fit.offset_m = length_of(so_far.head<3>(), covariance.topLeftCorner<3, 3>(), floor_m, offsets);
  fit.origin_offset_m =
      length_of(origin_of(so_far), origin_slope * covariance * origin_slope.transpose(), floor_m, origins);
  fit.turn_deg =
      length_of(degrees_per_radian * so_far.segment<3>(3),
                degrees_per_radian * degrees_per_radian * covariance.block<3, 3>(3, 3), floor_turn_deg, turns);
  return fit;
}

}  // namespace odosplat
