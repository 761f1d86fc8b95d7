// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window_optimizer.hpp"

#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/window_system.hpp"

namespace odosplat {
namespace {

constexpr int pose_size = 7;  // quaternion x y z w, then translation
constexpr int brightness_size = 2;

void store(const SE3& T, double* x) {
  Eigen::Map<Eigen::Vector4d>(x + 0) = T.rotation().coeffs();
  Eigen::Map<Eigen::Vector3d>(x + 4) = T.translation();
}

SE3 load(const double* x) {
  const Eigen::Map<const Eigen::Quaterniond> q(x);
  return {Eigen::Quaterniond(q), Eigen::Map<const Eigen::Vector3d>(x + 4)};
}

/// SE(3) with left perturbation. Costs write their Jacobians by the six tangent coordinates into the first six of the
/// seven ambient columns; PlusJacobian is made to match, which is all that the solver sees.
class LeftPose : public ceres::Manifold {
 public:
  int AmbientSize() const override { return pose_size; }
  int TangentSize() const override { return 6; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override {
    store(SE3::exp(Eigen::Map<const Vector6d>(delta)) * load(x), x_plus_delta);
    return true;
  }
  bool PlusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, pose_size, 6, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.topRows<6>().setIdentity();
    return true;
  }
  bool Minus(const double* y, const double* x, double* y_minus_x) const override {
    Eigen::Map<Vector6d> out(y_minus_x);
    out = (load(y) * load(x).inverse()).log();
    return true;
  }
  bool MinusJacobian(const double*, double* jacobian) const override {
    Eigen::Map<Eigen::Matrix<double, 6, pose_size, Eigen::RowMajor>> J(jacobian);
    J.setZero();
    J.leftCols<6>().setIdentity();
    return true;
  }
};

/// What the window's cost knows beside the images: weak priors.
struct Priors {
  SE3 oldest;                   // pose prior's centre
  Vector6d oldest_information;  // diagonal
  double gain_information;
  double offset_information;
};

/// All residuals of a window as one block (see the header). Parameter blocks: n poses, n brightness, n anchors'.
class WindowCost : public ceres::CostFunction {
 public:
  WindowCost(const Window& window, const Camera& camera, const PhotometricOptions& options, const Priors& priors)
      : window_(window), camera_(camera), options_(options), priors_(priors), n_(window.keyframes.size()) {
    for (std::size_t k = 0; k < n_; ++k) mutable_parameter_block_sizes()->push_back(pose_size);
    for (std::size_t k = 0; k < 2 * n_; ++k) mutable_parameter_block_sizes()->push_back(brightness_size);
    set_num_residuals(static_cast<int>(10 * n_) + 1);
  }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override {
    refresh(parameters);
    Eigen::Map<Eigen::VectorXd>(residuals, num_residuals()) = residual_;
    if (jacobians == nullptr) return true;
    for (std::size_t block = 0; block < 3 * n_; ++block) {
      if (jacobians[block] == nullptr) continue;
      const int ambient = block < n_ ? pose_size : brightness_size;
      const int tangent = block < n_ ? 6 : brightness_size;
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> J(jacobians[block],
                                                                                           num_residuals(), ambient);
      J.setZero();
      J.topLeftCorner(10 * static_cast<Eigen::Index>(n_), tangent) = factor_.middleCols(column(block), tangent);
    }
    return true;
  }

  const WindowSystem& system() const { return system_; }
  const Eigen::MatrixXd& hessian() const { return H_; }
  bool finite() const { return finite_; }

 private:
  Eigen::Index column(std::size_t block) const {
    if (block < n_) return static_cast<Eigen::Index>(8 * block);
    if (block < 2 * n_) return static_cast<Eigen::Index>(8 * (block - n_) + 6);
    return static_cast<Eigen::Index>(8 * n_ + 2 * (block - 2 * n_));
  }

  /// Ceres asks for the cost of a step and, if it is accepted, for the Jacobian at the same place: kept until then.
  void refresh(double const* const* parameters) const {
    std::vector<double> at;
    at.reserve(11 * n_);
    for (std::size_t block = 0; block < 3 * n_; ++block) {
      at.insert(at.end(), parameters[block], parameters[block] + (block < n_ ? pose_size : brightness_size));
    }
    if (at == at_) return;
    at_ = std::move(at);
    WindowState state;
    for (std::size_t k = 0; k < n_; ++k) {
      state.poses.push_back(load(parameters[k]));
      state.brightness.push_back({parameters[n_ + k][0], parameters[n_ + k][1]});
      state.anchors.push_back({parameters[2 * n_ + k][0], parameters[2 * n_ + k][1]});
    }
    system_ = evaluate_window(window_, state, camera_, options_);
    H_ = system_.H;
    Eigen::VectorXd g = system_.g;
    double cost = system_.cost;
    const auto add = [&](Eigen::Index i, double value, double information) {
      H_(i, i) += information;
      g[i] += information * value;
      cost += 0.5 * information * value * value;
    };
    // Left Jacobian of log taken as identity: the prior is weak and its argument small.
    const Vector6d drift = (state.poses[0] * priors_.oldest.inverse()).log();
    for (Eigen::Index i = 0; i < 6; ++i) add(i, drift[i], priors_.oldest_information[i]);
    for (std::size_t k = 0; k < n_; ++k) {
      add(column(n_ + k), state.brightness[k].a, priors_.gain_information);
      add(column(n_ + k) + 1, state.brightness[k].b, priors_.offset_information);
      add(column(2 * n_ + k), state.anchors[k].a, priors_.gain_information);
      add(column(2 * n_ + k) + 1, state.anchors[k].b, priors_.offset_information);
    }
    factorise(g, cost);
  }

  /// H = F^T F and F^T r = g with F upper triangular up to a permutation; the last residual holds what is left of the
  /// cost, so that |r|^2 / 2 is the cost itself.
  void factorise(const Eigen::VectorXd& g, double cost) const {
    const Eigen::Index size = H_.rows();
    const Eigen::VectorXd scale = H_.diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    const Eigen::LDLT<Eigen::MatrixXd> solver(scale.asDiagonal() * H_ * scale.asDiagonal());
    const Eigen::VectorXd d = solver.vectorD();
    Eigen::VectorXd y = solver.transpositionsP() * Eigen::VectorXd(scale.asDiagonal() * g);
    solver.matrixL().solveInPlace(y);
    factor_ = solver.matrixU();
    residual_ = Eigen::VectorXd::Zero(size + 1);
    for (Eigen::Index i = 0; i < size; ++i) {
      const double root = d[i] > 1e-12 ? std::sqrt(d[i]) : 0.0;
      factor_.row(i) *= root;
      residual_[i] = root > 0.0 ? y[i] / root : 0.0;
    }
    // By way of a permutation matrix: Eigen applies Transpositions on the right in the opposite order.
    factor_ = factor_ * Eigen::PermutationMatrix<Eigen::Dynamic>(solver.transpositionsP());
    factor_ = factor_ * scale.cwiseInverse().asDiagonal();
    residual_[size] = std::sqrt(std::max(0.0, 2.0 * cost - residual_.squaredNorm()));
    finite_ = factor_.allFinite() && residual_.allFinite();
  }

  const Window& window_;
  const Camera camera_;
  const PhotometricOptions options_;
  const Priors priors_;
  const std::size_t n_;
  mutable std::vector<double> at_;
  mutable WindowSystem system_;
  mutable Eigen::MatrixXd H_;
  mutable Eigen::MatrixXd factor_;
  mutable Eigen::VectorXd residual_;
  mutable bool finite_ = true;
};

/// The window moved so that the newest keyframe is near the origin: levers stay short however far the map extends.
void translate(Window& window, const Eigen::Vector3d& by) {
  const auto moved = [&by](const SE3& T) { return SE3(T.rotation(), T.translation() + by); };
  for (const auto& keyframe : window.keyframes) {
    keyframe->T_world_camera = moved(keyframe->T_world_camera);
    keyframe->anchor.T_world_view = moved(keyframe->anchor.T_world_view);
    for (WindowPoint& point : keyframe->points) point.plane_world.D += point.plane_world.N.dot(by);
    for (WindowPoint& point : keyframe->anchor.points) point.plane_world.D += point.plane_world.N.dot(by);
  }
}

double rmse_of(const std::vector<PairSystem>& pairs) {
  double squares = 0.0;
  int n = 0;
  for (const PairSystem& pair : pairs) {
    squares += pair.squares;
    n += pair.inliers;
  }
  return n > 0 ? std::sqrt(squares / n) : 0.0;
}

}  // namespace

void WindowOptimizerOptions::check() const {
  photometric.check();
  require(max_iterations >= 1, "window_optimizer.max_iterations", "at least 1");
  require(gain_sigma > 0.0 && offset_sigma > 0.0, "window_optimizer.gain_sigma and offset_sigma", "positive");
  require(gauge_translation > 0.0 && gauge_rotation > 0.0, "window_optimizer.gauge", "positive");
}

WindowOptimizer::WindowOptimizer(const WindowOptimizerOptions& options) : options_(options) { options_.check(); }

WindowSummary WindowOptimizer::optimize(Window& window, const Camera& camera) const {
  WindowSummary summary;
  const std::size_t n = window.keyframes.size();
  if (n == 0 || (n == 1 && window.keyframes[0]->anchor.points.empty())) return summary;
  const Eigen::Vector3d origin = window.keyframes.back()->T_world_camera.translation();
  translate(window, -origin);

  std::vector<double> x(11 * n);
  std::vector<double*> blocks;
  for (std::size_t k = 0; k < n; ++k) blocks.push_back(&x[pose_size * k]);
  for (std::size_t k = 0; k < 2 * n; ++k) blocks.push_back(&x[pose_size * n + brightness_size * k]);
  for (std::size_t k = 0; k < n; ++k) {
    const Keyframe& keyframe = *window.keyframes[k];
    store(keyframe.T_world_camera, blocks[k]);
    blocks[n + k][0] = keyframe.brightness.a;
    blocks[n + k][1] = keyframe.brightness.b;
    blocks[2 * n + k][0] = keyframe.anchor.brightness.a;
    blocks[2 * n + k][1] = keyframe.anchor.brightness.b;
  }
  Priors priors;
  priors.oldest = window.keyframes[0]->T_world_camera;
  const auto information = [](double sigma) { return 1.0 / (sigma * sigma); };
  priors.oldest_information << Eigen::Vector3d::Constant(information(options_.gauge_translation)),
      Eigen::Vector3d::Constant(information(options_.gauge_rotation));
  priors.gain_information = information(options_.gain_sigma);
  priors.offset_information = information(options_.offset_sigma);

  WindowCost cost(window, camera, options_.photometric, priors);
  LeftPose manifold;
  ceres::Problem::Options problem_options;
  problem_options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  problem_options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem problem(problem_options);
  for (std::size_t k = 0; k < n; ++k) problem.AddParameterBlock(blocks[k], pose_size, &manifold);
  for (std::size_t k = n; k < 3 * n; ++k) problem.AddParameterBlock(blocks[k], brightness_size);
  problem.AddResidualBlock(&cost, nullptr, blocks);
  ceres::Solver::Options solver;
  solver.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  solver.max_num_iterations = options_.max_iterations;
  solver.function_tolerance = 1e-5;
  solver.initial_trust_region_radius = 1e6;
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  ceres::Solver::Summary solved;
  ceres::Solve(solver, &problem, &solved);

  // The last evaluation may have been of a rejected step.
  std::vector<double> residuals(static_cast<std::size_t>(cost.num_residuals()));
  cost.Evaluate(blocks.data(), residuals.data(), nullptr);
  const bool usable = solved.IsSolutionUsable() && cost.finite();
  Eigen::MatrixXd covariance;
  if (usable) {
    const Eigen::VectorXd scale = cost.hessian().diagonal().cwiseMax(1e-12).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd scaled = scale.asDiagonal() * cost.hessian() * scale.asDiagonal();
    covariance = scale.asDiagonal() * scaled.ldlt().solve(Eigen::MatrixXd::Identity(scaled.rows(), scaled.cols())) *
                 scale.asDiagonal();
    for (std::size_t k = 0; k < n; ++k) {
      Keyframe& keyframe = *window.keyframes[k];
      keyframe.T_world_camera = load(blocks[k]);
      keyframe.brightness = {blocks[n + k][0], blocks[n + k][1]};
      keyframe.anchor.brightness = {blocks[2 * n + k][0], blocks[2 * n + k][1]};
    }
  }
  translate(window, origin);
  const Matrix6d shift = SE3(Eigen::Quaterniond::Identity(), origin).adjoint();
  for (std::size_t k = 0; usable && k < n; ++k) {
    const Matrix6d own = covariance.block<6, 6>(static_cast<Eigen::Index>(8 * k), static_cast<Eigen::Index>(8 * k));
    window.keyframes[k]->covariance = shift * own * shift.transpose();
  }

  summary.iterations = static_cast<int>(solved.iterations.size()) - 1;
  summary.initial_cost = solved.initial_cost;
  summary.final_cost = solved.final_cost;
  for (const PairSystem& pair : cost.system().pairs) {
    summary.residuals += pair.inliers;
    summary.outliers += pair.outliers;
  }
  summary.rmse = rmse_of(cost.system().pairs);
  summary.anchor_rmse = rmse_of(cost.system().anchors);
  const PairSystem& newest = cost.system().anchors.back();
  const int seen = newest.inliers + newest.outliers;
  summary.anchor_inliers = seen > 0 ? static_cast<double>(newest.inliers) / seen : 0.0;
  return summary;
}

}  // namespace odosplat
