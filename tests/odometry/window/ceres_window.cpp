// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "tests/odometry/window/ceres_window.hpp"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "odosplat/odometry/window/window_priors.hpp"
#include "odosplat/odometry/window/window_system.hpp"

namespace odosplat::test {
namespace {

/// The window's cost with all unknowns in one vector of tangent coordinates around the start. Poses are exp(x) T_start.
class WindowCost : public ceres::CostFunction {
 public:
  WindowCost(const Window& window, const Camera& camera, const WindowOptimizerOptions& options)
      : window_(window),
        camera_(camera),
        options_(options),
        priors_(make_window_priors(window, options)),
        start_(window_state(window)) {
    for (std::size_t k = 0; k < window.keyframes.size(); ++k) {
      for (std::size_t i = 0; i < start_.offsets[k].size(); ++i) offsets_.emplace_back(k, i);
    }
    keyframes_ = start_.anchor_column(window.keyframes.size());
    size_ = keyframes_ + static_cast<Eigen::Index>(offsets_.size());
    mutable_parameter_block_sizes()->push_back(static_cast<int>(size_));
    set_num_residuals(static_cast<int>(size_) + 1);
  }

  Eigen::Index size() const { return size_; }

  WindowState state_at(const double* parameters) const {
    const Eigen::Map<const Eigen::VectorXd> x(parameters, size_);
    WindowState state = start_;
    const std::size_t n = state.poses.size();
    for (std::size_t k = 0; k < n; ++k) {
      const auto p = static_cast<Eigen::Index>(8 * k);
      Eigen::Index a = start_.anchor_column(k);
      state.poses[k].T_world_camera = SE3::exp(x.segment<6>(p)) * start_.poses[k].T_world_camera;
      state.poses[k].T_linearised = state.poses[k].T_world_camera;
      state.brightness[k].a += x[p + 6];
      state.brightness[k].b += x[p + 7];
      for (Brightness& anchor : state.anchors[k]) {
        anchor.a += x[a++];
        anchor.b += x[a++];
      }
    }
    for (std::size_t i = 0; i < offsets_.size(); ++i) {
      state.offsets[offsets_[i].first][offsets_[i].second] += x[keyframes_ + static_cast<Eigen::Index>(i)];
    }
    return state;
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    WindowSystem system = evaluate_window(window_, state_at(parameters[0]), camera_, options_.photometric);
    add_window_priors(window_, state_at(parameters[0]), priors_, system);
    Eigen::MatrixXd H = Eigen::MatrixXd::Zero(size_, size_);
    Eigen::VectorXd g = Eigen::VectorXd::Zero(size_);
    H.topLeftCorner(keyframes_, keyframes_) = system.H;
    g.head(keyframes_) = system.g;
    Eigen::Index at = keyframes_;
    for (const HostDepths& depths : system.depths) {
      const Eigen::Index n = depths.H.size();
      H.block(at, at, n, n).diagonal() = depths.H;
      H.block(0, at, depths.cross.rows(), n) = depths.cross;
      H.block(at, 0, n, depths.cross.rows()) = depths.cross.transpose();
      g.segment(at, n) = depths.g;
      at += n;
    }
    // H = F^T F, F^T r = g; the last residual contains the rest of the cost.
    const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-6).cwiseSqrt().cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(scale.asDiagonal() * H * scale.asDiagonal());
    const Eigen::VectorXd roots = eigen.eigenvalues().cwiseMax(1e-12).cwiseSqrt();
    Eigen::Map<Eigen::VectorXd> r(residuals, size_ + 1);
    const Eigen::VectorXd turned = eigen.eigenvectors().transpose() * Eigen::VectorXd(scale.asDiagonal() * g);
    r.head(size_) = turned.cwiseQuotient(roots);
    const double rest = 2.0 * system.cost - r.head(size_).squaredNorm();
    r[size_] = std::sqrt(std::max(0.0, rest));
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(jacobians[0], size_ + 1,
                                                                                           size_);
      J.setZero();
      J.topRows(size_) =
          roots.asDiagonal() * eigen.eigenvectors().transpose() * Eigen::MatrixXd(scale.cwiseInverse().asDiagonal());
    }
    return r.allFinite();
  }

 private:
  const Window& window_;
  const Camera camera_;
  const WindowOptimizerOptions options_;
  const WindowPriors priors_;
  const WindowState start_;
  std::vector<std::pair<std::size_t, std::size_t>> offsets_;
  Eigen::Index keyframes_ = 0;
  Eigen::Index size_ = 0;
};

}  // namespace

CeresOutcome optimize_with_ceres(Window& window, const Camera& camera, const WindowOptimizerOptions& options,
                                 int max_iterations) {
  const Eigen::Vector3d origin = window.keyframes.back()->T_world_camera.translation();
  translate(window, -origin);
  WindowCost cost(window, camera, options);
  std::vector<double> x(static_cast<std::size_t>(cost.size()), 0.0);
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  problem.AddResidualBlock(&cost, nullptr, x.data());
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = max_iterations;
  solver.function_tolerance = 1e-10;
  solver.gradient_tolerance = 1e-12;
  solver.parameter_tolerance = 1e-12;
  solver.initial_trust_region_radius = 1e6;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(solver, &problem, &summary);
  const WindowState state = cost.state_at(x.data());
  for (std::size_t k = 0; k < window.keyframes.size(); ++k) {
    window.keyframes[k]->T_world_camera = state.poses[k].T_world_camera;
    for (std::size_t i = 0; i < state.offsets[k].size(); ++i)
      window.keyframes[k]->points[i].offset = state.offsets[k][i];
  }
  translate(window, origin);
  return {summary.initial_cost, summary.final_cost, static_cast<int>(summary.iterations.size())};
}

}  // namespace odosplat::test
