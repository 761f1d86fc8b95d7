// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/window_optimizer.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/window/window_priors.hpp"
#include "odosplat/odometry/window/window_system.hpp"

namespace odosplat {
namespace {

constexpr double first_damping = 1e-5;
constexpr double least_damping = 1e-8;
constexpr int most_rejections = 4;  // in a row

/// Solves equations of different units, scaled to a diagonal of ones.
class ScaledSolver {
 public:
  explicit ScaledSolver(const Eigen::MatrixXd& H)
      : scale_(H.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse()),
        solver_(scale_.asDiagonal() * H * scale_.asDiagonal()) {}

  Eigen::VectorXd solve(const Eigen::VectorXd& g) const {
    return scale_.cwiseProduct(solver_.solve(scale_.cwiseProduct(g)));
  }

 private:
  Eigen::VectorXd scale_;
  Eigen::LDLT<Eigen::MatrixXd> solver_;
};

void write_back(const WindowState& state, const WindowSystem& system, Window& window) {
  for (std::size_t k = 0; k < window.keyframes.size(); ++k) {
    Keyframe& keyframe = *window.keyframes[k];
    keyframe.T_world_camera = state.poses[k].T_world_camera;
    keyframe.brightness = state.brightness[k];
    for (std::size_t i = 0; i < keyframe.anchors.size(); ++i) keyframe.anchors[i].brightness = state.anchors[k][i];
    for (std::size_t i = 0; i < system.depths[k].points.size(); ++i) {
      WindowPoint& point = keyframe.points[system.depths[k].points[i]];
      point.offset = state.offsets[k][system.depths[k].points[i]];
      std::tie(point.agreeing, point.contradicting) = system.counts[k][i];
    }
  }
}

/// H^-1, where H is information. Pair sums are of single precision: eigenvalues of H, scaled to a diagonal of ones,
/// that are below the rounding error may even be negative, and are raised to it.
Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& H) {
  constexpr double rounding = 1e-7;
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * H * scale.asDiagonal());
  const Eigen::VectorXd inverse = eigen.eigenvalues().cwiseMax(rounding).cwiseInverse();
  const Eigen::MatrixXd V = scale.asDiagonal() * eigen.eigenvectors();
  return V * inverse.asDiagonal() * V.transpose();
}

}  // namespace

void WindowOptimizerOptions::check() const {
  photometric.check();
  require(max_iterations >= 1, "window_optimizer.max_iterations", "at least 1");
  require(converged >= 0.0, "window_optimizer.converged", "at least 0");
  require(gain_sigma > 0.0 && offset_sigma > 0.0, "window_optimizer.gain_sigma and offset_sigma", "positive");
  require(tracked_translation > 0.0 && tracked_rotation > 0.0, "window_optimizer.tracked", "positive");
  require(gauge_translation > 0.0 && gauge_rotation > 0.0, "window_optimizer.gauge", "positive");
}

WindowOptimizer::WindowOptimizer(const WindowOptimizerOptions& options) : options_(options) { options_.check(); }

WindowSummary WindowOptimizer::optimize(Window& window, const Camera& camera) const {
  WindowSummary summary;
  const std::size_t n = window.keyframes.size();
  if (n == 0) return summary;
  if (n == 1 && window.keyframes[0]->anchors.empty()) {
    // Nothing to compare it with: its covariance is that of the gauge prior.
    Keyframe& only = *window.keyframes[0];
    Vector6d variance;
    variance << Eigen::Vector3d::Constant(options_.gauge_translation * options_.gauge_translation),
        Eigen::Vector3d::Constant(options_.gauge_rotation * options_.gauge_rotation);
    const Matrix6d shift = SE3(Eigen::Quaterniond::Identity(), only.T_world_camera.translation()).adjoint();
    only.covariance = shift * variance.asDiagonal() * shift.transpose();
    return summary;
  }
  // The newest keyframe is moved to the origin: lever arms stay short however far the map extends.
  const Eigen::Vector3d origin = window.keyframes.back()->T_world_camera.translation();
  translate(window, -origin);

  const WindowPriors priors = make_window_priors(window, options_);
  const auto evaluate = [&](const WindowState& at) {
    WindowSystem system = evaluate_window(window, at, camera, options_.photometric);
    add_window_priors(window, at, priors, system);
    return system;
  };
  WindowState state = window_state(window);
  WindowSystem system = evaluate(state);
  summary.initial_cost = system.cost;
  double damping = first_damping;
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  int rejections = 0;
  while (summary.iterations < options_.max_iterations && rejections < most_rejections) {
    reduce_system(system, damping, H, g);
    const Eigen::VectorXd step = -ScaledSolver(H).solve(g);
    if (!step.allFinite()) break;
    WindowState candidate = stepped(state, system, step, damping);
    WindowSystem next = evaluate(candidate);
    if (!std::isfinite(next.cost) || next.cost > system.cost) {
      damping *= 10.0;
      ++rejections;
      continue;
    }
    const bool last = system.cost - next.cost < options_.converged * std::abs(system.cost);
    state = std::move(candidate);
    system = std::move(next);
    damping = std::max(least_damping, 0.1 * damping);
    rejections = 0;
    ++summary.iterations;
    if (last) break;
  }

  reduce_system(system, 0.0, H, g);
  const Eigen::MatrixXd covariance = covariance_of(H);
  write_back(state, system, window);
  translate(window, origin);
  const Matrix6d shift = SE3(Eigen::Quaterniond::Identity(), origin).adjoint();
  for (std::size_t k = 0; k < n; ++k) {
    const Matrix6d own = covariance.block<6, 6>(static_cast<Eigen::Index>(8 * k), static_cast<Eigen::Index>(8 * k));
    Keyframe& keyframe = *window.keyframes[k];
    keyframe.covariance = shift * own * shift.transpose();
    // The errors of its anchors are correlated: the mean of their covariances is added, not that of independent views.
    for (const Anchor& anchor : keyframe.anchors) {
      keyframe.covariance += anchor.covariance / static_cast<double>(keyframe.anchors.size());
    }
  }

  summary.final_cost = system.cost;
  return summary;
}

}  // namespace odosplat
