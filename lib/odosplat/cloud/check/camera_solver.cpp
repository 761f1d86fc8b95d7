// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/camera_solver.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/pair_scores.hpp"

namespace odosplat {
namespace {

constexpr int camera_size = CameraState::size;
constexpr std::size_t pair_groups = 8;  // of the jackknife
constexpr int reweighted = 6;
constexpr double spread_floor = 0.03;  // [px] lower limit for the spread of the matches
// The errors of a pair's patches are correlated (lens, shutter, depth, planes): its equations count as this much fewer.
constexpr double correlated = 5.0;
// Range of the poses' noise.
constexpr double noise_least_m = 1e-4;
constexpr double noise_most_m = 0.1;
constexpr double noise_least_rad = 3e-5;
constexpr double noise_most_rad = 0.1;

using StateVector = CameraState::Vector;
using StateMatrix = CameraState::Matrix;

double residual(const CameraEquation& e, const StateVector& state, const Vector6d& pose) {
  return e.distance - e.by_state.dot(state) - e.by_pose.dot(pose);
}

/// Weighted sums over the equations of a pair: the cost of a step (state, pose) is
/// squares - 2 (b . state + g . pose) + state' A state + 2 state' C pose + pose' H pose.
struct PairSums {
  StateMatrix A = StateMatrix::Zero();
  Eigen::Matrix<double, camera_size, 6> C = Eigen::Matrix<double, camera_size, 6>::Zero();
  Matrix6d H = Matrix6d::Zero();
  StateVector b = StateVector::Zero();
  Vector6d g = Vector6d::Zero();
  double squares = 0.0;
  Vector6d so_far = Vector6d::Zero();  // how much the relative pose has been corrected already
};

PairSums sums_of(const PairPart& part, const StateVector& state, double spread) {
  PairSums sums;
  sums.so_far = part.pair.T_to_given.log();
  const double limit = 4.685 * spread;
  for (const CameraEquation& e : part.equations) {
    const double share = residual(e, state, part.change) / limit;
    if (std::abs(share) >= 1.0) continue;
    const double weight = (1.0 - share * share) * (1.0 - share * share) / (correlated * spread * spread);
    sums.A += weight * e.by_state.transpose() * e.by_state;
    sums.C += weight * e.by_state.transpose() * e.by_pose;
    sums.H += weight * e.by_pose.transpose() * e.by_pose;
    sums.b += weight * e.distance * e.by_state.transpose();
    sums.g += weight * e.distance * e.by_pose.transpose();
    sums.squares += weight * e.distance * e.distance;
  }
  return sums;
}

Vector6d information_of(const PoseNoise& noise) {
  const double m = 1.0 / (noise.meters * noise.meters);
  const double r = 1.0 / (noise.radians * noise.radians);
  return {m, m, m, r, r, r};
}

/// A pair's sums with its pose eliminated.
struct ReducedPair {
  StateMatrix A;
  StateVector b;
  double squares;
  double log_volume;  // logarithm of the determinant of the pose's information over that of its prior
};

ReducedPair reduce(const PairSums& sums, const Vector6d& information) {
  const Matrix6d H = sums.H + Matrix6d(information.asDiagonal());
  const Vector6d g = sums.g - information.cwiseProduct(sums.so_far);
  const Eigen::LLT<Matrix6d> llt(H);
  const Eigen::Matrix<double, 6, camera_size> HC = llt.solve(sums.C.transpose());
  const Vector6d Hg = llt.solve(g);
  const Matrix6d L = llt.matrixL();
  return {sums.A - sums.C * HC, sums.b - sums.C * Hg,
          sums.squares + information.dot(sums.so_far.cwiseProduct(sums.so_far)) - g.dot(Hg),
          2.0 * L.diagonal().array().log().sum() - information.array().log().sum()};
}

/// The camera's step for one level of the poses' noise.
struct CameraSolution {
  StateMatrix A;
  StateVector b;
  StateVector value;
  double cost = std::numeric_limits<double>::infinity();  // -2 times the logarithm of the noise's likelihood
};

CameraSolution solve_with(const std::vector<PairSums>& sums, const PoseNoise& noise, const StateVector& prior,
                          const StateVector& so_far) {
  CameraSolution solution;
  solution.A = prior.asDiagonal();
  solution.b = -prior.cwiseProduct(so_far);
  double cost = prior.dot(so_far.cwiseProduct(so_far));
  const Vector6d information = information_of(noise);
  for (const PairSums& pair : sums) {
    const ReducedPair reduced = reduce(pair, information);
    solution.A += reduced.A;
    solution.b += reduced.b;
    cost += reduced.squares + reduced.log_volume;
  }
  const Eigen::LDLT<StateMatrix> ldlt(solution.A);
  solution.value = ldlt.solve(solution.b);
  solution.cost = cost - solution.b.dot(solution.value) + ldlt.vectorD().array().abs().log().sum();
  return solution;
}

/// The noise of the poses with the largest marginal likelihood: by a grid, and finer grids around its best cell.
PoseNoise most_likely_noise(const std::vector<PairSums>& sums, const StateVector& prior, const StateVector& so_far) {
  PoseNoise best;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](double meters, double radians) {
    const PoseNoise noise{std::clamp(meters, noise_least_m, noise_most_m),
                          std::clamp(radians, noise_least_rad, noise_most_rad)};
    const double cost = solve_with(sums, noise, prior, so_far).cost;
    if (!(cost < least)) return;
    least = cost;
    best = noise;
  };
  constexpr double coarse = 4.0;
  for (double meters = noise_least_m; meters < coarse * noise_most_m; meters *= coarse) {
    for (double radians = noise_least_rad; radians < coarse * noise_most_rad; radians *= coarse)
      attempt(meters, radians);
  }
  for (const double fine : {2.0, 1.4, 1.2}) {
    const PoseNoise middle = best;
    for (const double m : {1.0 / fine, 1.0, fine}) {
      for (const double r : {1.0 / fine, 1.0, fine}) attempt(middle.meters * m, middle.radians * r);
    }
  }
  return best;
}

/// Robust standard deviation of what no pose explains of the distances.
double spread_of(std::vector<PairPart>& parts, const StateVector& state) {
  constexpr double any = 1.0;  // a prior for the poses that permits every one
  for (int pass = 0; pass < 2; ++pass) {
    std::vector<double> sizes;
    for (const PairPart& part : parts) {
      for (const CameraEquation& e : part.equations) sizes.push_back(std::abs(residual(e, state, part.change)));
    }
    const double spread = std::max(spread_floor, 1.4826 * median_of(std::move(sizes)));
    if (pass == 1) return spread;
    for (PairPart& part : parts) {
      const PairSums sums = sums_of(part, state, spread);
      const Matrix6d H = sums.H + Matrix6d(information_of({any, any}).asDiagonal());
      part.change = H.ldlt().solve(sums.g - sums.C.transpose() * state);
    }
  }
  return spread_floor;
}

}  // namespace

CameraStep solve_camera(std::vector<PairPart>& parts, const StateVector& prior, const StateVector& so_far) {
  CameraStep step;
  std::vector<PairPart> unbound = parts;
  std::vector<PairSums> sums(parts.size());
  CameraSolution solution;
  for (int pass = 0; pass < reweighted; ++pass) {
    const double spread = spread_of(unbound, step.value);
    // At first the distances are large by the errors that are looked for: weights as with free poses.
    const std::vector<PairPart>& weighed = pass == 0 ? unbound : parts;
    for (std::size_t k = 0; k < parts.size(); ++k) sums[k] = sums_of(weighed[k], step.value, spread);
    step.noise = most_likely_noise(sums, prior, so_far);
    solution = solve_with(sums, step.noise, prior, so_far);
    step.value = solution.value;
    const Vector6d information = information_of(step.noise);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      const Matrix6d H = sums[k].H + Matrix6d(information.asDiagonal());
      const Vector6d g = sums[k].g - information.cwiseProduct(sums[k].so_far);
      parts[k].change = H.ldlt().solve(g - sums[k].C.transpose() * step.value);
    }
  }
  step.covariance = solution.A.ldlt().solve(StateMatrix::Identity());
  for (std::size_t group = 0; group < pair_groups; ++group) {
    StateMatrix A = solution.A;
    StateVector b = solution.b;
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (k * pair_groups / parts.size() != group) continue;
      const ReducedPair reduced = reduce(sums[k], information_of(step.noise));
      A -= reduced.A;
      b -= reduced.b;
    }
    step.without.emplace_back(A.ldlt().solve(b));
  }
  return step;
}

double median_distance(const std::vector<PairPart>& parts, const StateVector& state,
                       const std::vector<Vector6d>& poses) {
  std::vector<double> distances;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    for (const CameraEquation& e : parts[k].equations) distances.push_back(std::abs(residual(e, state, poses[k])));
  }
  return median_of(std::move(distances));
}

}  // namespace odosplat
