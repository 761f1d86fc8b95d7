// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/window_system.hpp"

#include <algorithm>
#include <utility>

#include "odosplat/core/parallel.hpp"

namespace odosplat {
namespace {

bool estimates_depth(const Keyframe& keyframe) {
  return std::any_of(keyframe.points.begin(), keyframe.points.end(), [](const WindowPoint& p) { return p.estimated; });
}

/// Gathers one host's offsets from its pairs. terms_of(target) gives the terms of that pair.
template <typename TermsOf>
void gather_depths(const Keyframe& host, std::size_t host_index, std::size_t n, const std::vector<double>& offsets,
                   const TermsOf& terms_of, HostDepths& depths, std::vector<std::pair<int, int>>& counts,
                   double& prior_cost) {
  for (std::size_t i = 0; i < host.points.size(); ++i) {
    if (host.points[i].estimated) depths.points.push_back(i);
  }
  const auto size = static_cast<Eigen::Index>(depths.points.size());
  depths.H = Eigen::VectorXd::Zero(size);
  depths.g = Eigen::VectorXd::Zero(size);
  depths.cross = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(8 * n), size);
  counts.assign(depths.points.size(), {0, 0});
  const auto h = static_cast<Eigen::Index>(8 * host_index);
  for (Eigen::Index column = 0; column < size; ++column) {
    const std::size_t i = depths.points[static_cast<std::size_t>(column)];
    const double information = host.points[i].prior_information;
    depths.H[column] = information;
    depths.g[column] = information * offsets[i];
    prior_cost += 0.5 * information * offsets[i] * offsets[i];
    auto& [agreeing, contradicting] = counts[static_cast<std::size_t>(column)];
    for (std::size_t target = 0; target < n; ++target) {
      if (target == host_index) continue;
      const DepthTerms& terms = terms_of(target)[i];
      contradicting += terms.outlier ? 1 : 0;
      if (!terms.inlier) continue;
      ++agreeing;
      depths.H[column] += terms.H;
      depths.g[column] += terms.g;
      depths.cross.col(column).segment<8>(h) += terms.cross.head<8>().cast<double>();
      depths.cross.col(column).segment<8>(static_cast<Eigen::Index>(8 * target)) +=
          terms.cross.tail<8>().cast<double>();
    }
  }
}

}  // namespace

Eigen::Index WindowState::anchor_column(std::size_t k) const {
  std::size_t before = 0;
  for (std::size_t i = 0; i < k; ++i) before += anchors[i].size();
  return static_cast<Eigen::Index>(8 * poses.size() + 2 * before);
}

WindowState window_state(const Window& window) {
  WindowState state;
  for (const auto& keyframe : window.keyframes) {
    const int fixed = window.prior.find(keyframe.get());
    const SE3& T = keyframe->T_world_camera;
    state.poses.push_back(
        {T, fixed >= 0 ? window.prior.frames[static_cast<std::size_t>(fixed)].T_linearised : T, fixed >= 0});
    state.brightness.push_back(keyframe->brightness);
    state.anchors.emplace_back();
    for (const Anchor& anchor : keyframe->anchors) state.anchors.back().push_back(anchor.brightness);
    state.offsets.emplace_back();
    if (!estimates_depth(*keyframe)) continue;
    for (const WindowPoint& point : keyframe->points) state.offsets.back().push_back(point.offset);
  }
  return state;
}

WindowSystem evaluate_window(const Window& window, const WindowState& state, const Camera& camera,
                             const PhotometricOptions& options, int only) {
  const std::size_t n = window.keyframes.size();
  std::vector<std::vector<HostPoint>> hosts(n);
  std::vector<std::vector<HostPoint>> views;  // of all anchors, keyframe by keyframe
  std::vector<PhotometricPair> tasks;
  std::vector<std::vector<DepthTerms>> terms(n * n);
  for (std::size_t k = 0; k < n; ++k) {
    hosts[k] = make_host_points(window.keyframes[k]->points, state.offsets[k], camera, state.poses[k]);
    for (const Anchor& anchor : window.keyframes[k]->anchors) {
      views.push_back(make_host_points(anchor.points, {}, camera, {anchor.T_world_view, anchor.T_world_view, false}));
    }
  }
  for (std::size_t host = 0; host < n; ++host) {
    for (std::size_t target = 0; target < n; ++target) {
      if (target == host) continue;
      tasks.push_back({window.keyframes[host]->points, hosts[host], &window.keyframes[target]->gradient, camera,
                       state.poses[host], state.poses[target], state.brightness[host], state.brightness[target], 1.0});
    }
  }
  std::vector<std::size_t> anchored;  // keyframe of each anchor
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t i = 0; i < window.keyframes[k]->anchors.size(); ++i) {
      const Anchor& anchor = window.keyframes[k]->anchors[i];
      tasks.push_back({anchor.points,
                       views[anchored.size()],
                       &window.keyframes[k]->gradient,
                       camera,
                       {anchor.T_world_view, anchor.T_world_view, false},
                       state.poses[k],
                       state.anchors[k][i],
                       state.brightness[k],
                       anchor.weight});
      anchored.push_back(k);
    }
  }
  std::vector<PairSystem> results(tasks.size());
  parallel_for(static_cast<int>(tasks.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto task = static_cast<std::size_t>(i);
      const bool anchor = task >= n * (n - 1);
      const std::size_t host = anchor ? anchored[task - n * (n - 1)] : task / (n - 1);
      const std::size_t target = anchor ? host : task % (n - 1) + (task % (n - 1) >= host ? 1 : 0);
      const bool wanted =
          only < 0 || host == static_cast<std::size_t>(only) || target == static_cast<std::size_t>(only);
      std::span<DepthTerms> of_pair;
      if (!anchor && !state.offsets[host].empty()) {
        terms[host * n + target].resize(tasks[task].points.size());
        of_pair = terms[host * n + target];
      }
      if (!wanted || tasks[task].points.empty()) continue;
      results[task] = evaluate_pair(tasks[task], options, of_pair);
    }
  });

  WindowSystem system;
  system.depths.resize(n);
  system.counts.resize(n);
  std::vector<double> prior_costs(n, 0.0);
  parallel_for(static_cast<int>(n), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto host = static_cast<std::size_t>(i);
      if (state.offsets[host].empty()) continue;
      gather_depths(
          *window.keyframes[host], host, n, state.offsets[host],
          [&](std::size_t target) -> const std::vector<DepthTerms>& { return terms[host * n + target]; },
          system.depths[host], system.counts[host], prior_costs[host]);
    }
  });
  const Eigen::Index size = state.anchor_column(n);
  system.H = Eigen::MatrixXd::Zero(size, size);
  system.g = Eigen::VectorXd::Zero(size);
  for (const double cost : prior_costs) system.cost += cost;
  std::size_t task = 0;
  for (std::size_t host = 0; host < n; ++host) {
    for (std::size_t target = 0; target < n; ++target) {
      if (target == host) continue;
      const PairSystem& pair = results[task++];
      const auto h = static_cast<Eigen::Index>(8 * host);
      const auto t = static_cast<Eigen::Index>(8 * target);
      system.H.block<8, 8>(h, h) += pair.H.block<8, 8>(0, 0);
      system.H.block<8, 8>(h, t) += pair.H.block<8, 8>(0, 8);
      system.H.block<8, 8>(t, h) += pair.H.block<8, 8>(8, 0);
      system.H.block<8, 8>(t, t) += pair.H.block<8, 8>(8, 8);
      system.g.segment<8>(h) += pair.g.head<8>();
      system.g.segment<8>(t) += pair.g.tail<8>();
      system.cost += pair.cost;
      system.pairs.push_back(pair);
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const auto t = static_cast<Eigen::Index>(8 * k);
    auto a = state.anchor_column(k);
    for (std::size_t i = 0; i < state.anchors[k].size(); ++i, a += 2) {
      const PairSystem& pair = results[task++];
      // The view's pose is known: its six rows and columns are left out.
      system.H.block<8, 8>(t, t) += pair.H.block<8, 8>(8, 8);
      system.H.block<2, 8>(a, t) += pair.H.block<2, 8>(6, 8);
      system.H.block<8, 2>(t, a) += pair.H.block<8, 2>(8, 6);
      system.H.block<2, 2>(a, a) += pair.H.block<2, 2>(6, 6);
      system.g.segment<8>(t) += pair.g.tail<8>();
      system.g.segment<2>(a) += pair.g.segment<2>(6);
      system.cost += pair.cost;
    }
  }
  return system;
}

void add_marginal_prior(const Window& window, const WindowState& state, WindowSystem& system) {
  const MarginalPrior& prior = window.prior;
  const std::size_t m = prior.frames.size();
  if (m == 0) return;
  std::vector<Eigen::Index> columns(m);  // first of each frame's eight
  Eigen::VectorXd x(static_cast<Eigen::Index>(8 * m));
  for (std::size_t i = 0; i < m; ++i) {
    const auto found = std::find(window.keyframes.begin(), window.keyframes.end(), prior.frames[i].keyframe);
    const auto k = static_cast<std::size_t>(found - window.keyframes.begin());
    columns[i] = static_cast<Eigen::Index>(8 * k);
    x.segment<8>(static_cast<Eigen::Index>(8 * i)) =
        marginal_deviation(prior.frames[i], state.poses[k].T_world_camera, state.brightness[k]);
  }
  const Eigen::VectorXd Hx = prior.H * x;
  for (std::size_t i = 0; i < m; ++i) {
    const auto row = static_cast<Eigen::Index>(8 * i);
    for (std::size_t j = 0; j < m; ++j) {
      system.H.block<8, 8>(columns[i], columns[j]) += prior.H.block<8, 8>(row, static_cast<Eigen::Index>(8 * j));
    }
    system.g.segment<8>(columns[i]) += prior.g.segment<8>(row) + Hx.segment<8>(row);
  }
  system.cost += prior.g.dot(x) + 0.5 * x.dot(Hx);
}

void reduce_system(const WindowSystem& system, double damping, Eigen::MatrixXd& H, Eigen::VectorXd& g) {
  H = system.H;
  g = system.g;
  H.diagonal() *= 1.0 + damping;
  std::vector<Eigen::MatrixXd> H_parts(system.depths.size());
  std::vector<Eigen::VectorXd> g_parts(system.depths.size());
  parallel_for(static_cast<int>(system.depths.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (system.depths[k].points.empty()) continue;
      const Eigen::Index rows = system.depths[k].cross.rows();
      H_parts[k] = Eigen::MatrixXd::Zero(rows, rows);
      g_parts[k] = Eigen::VectorXd::Zero(rows);
      eliminate_depths(system.depths[k], damping, H_parts[k], g_parts[k]);
    }
  });
  for (std::size_t k = 0; k < H_parts.size(); ++k) {
    if (H_parts[k].size() == 0) continue;
    H.topLeftCorner(H_parts[k].rows(), H_parts[k].cols()) += H_parts[k];
    g.head(g_parts[k].size()) += g_parts[k];
  }
}

WindowState stepped(const WindowState& state, const WindowSystem& system, const Eigen::VectorXd& step, double damping) {
  WindowState next = state;
  const std::size_t n = state.poses.size();
  for (std::size_t k = 0; k < n; ++k) {
    const auto p = static_cast<Eigen::Index>(8 * k);
    Eigen::Index a = state.anchor_column(k);
    PoseEstimate& pose = next.poses[k];
    pose.T_world_camera = SE3::exp(step.segment<6>(p)) * pose.T_world_camera;
    if (!pose.fixed) pose.T_linearised = pose.T_world_camera;
    next.brightness[k].a += step[p + 6];
    next.brightness[k].b += step[p + 7];
    for (Brightness& anchor : next.anchors[k]) {
      anchor.a += step[a++];
      anchor.b += step[a++];
    }
    if (system.depths[k].points.empty()) continue;
    const Eigen::VectorXd change = depth_steps(system.depths[k], damping, step);
    for (Eigen::Index i = 0; i < change.size(); ++i) {
      next.offsets[k][system.depths[k].points[static_cast<std::size_t>(i)]] += change[i];
    }
  }
  return next;
}

}  // namespace odosplat
