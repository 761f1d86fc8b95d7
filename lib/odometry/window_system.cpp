// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window_system.hpp"

#include "odosplat/core/parallel.hpp"

namespace odosplat {

WindowState window_state(const Window& window) {
  WindowState state;
  for (const auto& keyframe : window.keyframes) {
    state.poses.push_back(keyframe->T_world_camera);
    state.brightness.push_back(keyframe->brightness);
    state.anchors.push_back(keyframe->anchor.brightness);
  }
  return state;
}

WindowSystem evaluate_window(const Window& window, const WindowState& state, const Camera& camera,
                             const PhotometricOptions& options) {
  const std::size_t n = window.keyframes.size();
  std::vector<PhotometricPair> tasks;
  for (std::size_t host = 0; host < n; ++host) {
    for (std::size_t target = 0; target < n; ++target) {
      if (target == host) continue;
      tasks.push_back({&window.keyframes[host]->points, &window.keyframes[target]->gradient, camera, state.poses[host],
                       state.poses[target], state.brightness[host], state.brightness[target], 1.0});
    }
  }
  for (std::size_t k = 0; k < n; ++k) {
    const MapAnchor& anchor = window.keyframes[k]->anchor;
    tasks.push_back({&anchor.points, &window.keyframes[k]->gradient, camera, anchor.T_world_view, state.poses[k],
                     state.anchors[k], state.brightness[k], anchor.weight});
  }
  std::vector<PairSystem> results(tasks.size());
  parallel_for(static_cast<int>(tasks.size()), 1, [&](int begin, int end) {
    for (int i = begin; i < end; ++i) {
      const auto task = static_cast<std::size_t>(i);
      if (!tasks[task].points->empty()) results[task] = evaluate_pair(tasks[task], options);
    }
  });

  WindowSystem system;
  const auto size = static_cast<Eigen::Index>(10 * n);
  system.H = Eigen::MatrixXd::Zero(size, size);
  system.g = Eigen::VectorXd::Zero(size);
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
    const PairSystem& pair = results[task++];
    const auto t = static_cast<Eigen::Index>(8 * k);
    const auto a = static_cast<Eigen::Index>(8 * n + 2 * k);
    // The rendered view's pose is known: its six rows and columns are left out.
    system.H.block<8, 8>(t, t) += pair.H.block<8, 8>(8, 8);
    system.H.block<2, 8>(a, t) += pair.H.block<2, 8>(6, 8);
    system.H.block<8, 2>(t, a) += pair.H.block<8, 2>(8, 6);
    system.H.block<2, 2>(a, a) += pair.H.block<2, 2>(6, 6);
    system.g.segment<8>(t) += pair.g.tail<8>();
    system.g.segment<2>(a) += pair.g.segment<2>(6);
    system.cost += pair.cost;
    system.anchors.push_back(pair);
  }
  return system;
}

}  // namespace odosplat
