// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/marginalization.hpp"

#include <algorithm>

#include "odosplat/core/error.hpp"
#include "odosplat/odometry/window/window_priors.hpp"
#include "odosplat/odometry/window/window_system.hpp"

namespace odosplat {
namespace {

/// The window with only those points that are to be marginalized with keyframe `index`; `state` is reduced with it.
Window points_to_marginalize(const Window& window, std::size_t index, const MarginalizationOptions& options,
                             WindowState& state) {
  Window part;
  for (std::size_t k = 0; k < window.keyframes.size(); ++k) {
    const Keyframe& from = *window.keyframes[k];
    auto keyframe = std::make_shared<Keyframe>();
    keyframe->gradient = from.gradient;
    state.offsets[k].clear();
    if (k == index) {
      keyframe->anchors = from.anchors;
    } else {
      state.anchors[k].clear();
    }
    for (const WindowPoint& point : from.points) {
      if (point.estimated && (k != index || point.agreeing < options.min_agreeing)) continue;
      keyframe->points.push_back(point);
      if (k == index) state.offsets[k].push_back(point.offset);
    }
    part.keyframes.push_back(keyframe);
  }
  return part;
}

/// The prior, in the order of its frames, with one frame taken out.
void drop_from_prior(MarginalPrior& prior, int frame) {
  if (frame < 0) return;
  std::vector<Eigen::Index> out;
  for (Eigen::Index i = 0; i < 8; ++i) out.push_back(8 * frame + i);
  marginalize(prior.H, prior.g, out);
  prior.frames.erase(prior.frames.begin() + frame);
  if (prior.frames.empty()) prior.clear();
}

}  // namespace

void MarginalizationOptions::check() const {
  require(min_agreeing >= 1, "marginalization.min_agreeing", "at least 1");
  require(weight > 0.0 && weight <= 1.0, "marginalization.weight", "in (0, 1]");
}

void marginalize_keyframe(Window& window, std::size_t index, const Camera& camera,
                          const WindowOptimizerOptions& optimizer, const MarginalizationOptions& options) {
  const std::size_t n = window.keyframes.size();
  if (!options.enabled) {
    drop_from_prior(window.prior, window.prior.find(window.keyframes[index].get()));
    window.keyframes.erase(window.keyframes.begin() + static_cast<std::ptrdiff_t>(index));
    return;
  }
  const Eigen::Vector3d origin = window.keyframes.back()->T_world_camera.translation();
  translate(window, -origin);
  WindowState state = window_state(window);
  const WindowState whole = state;
  const Window part = points_to_marginalize(window, index, options, state);
  WindowSystem system = evaluate_window(part, state, camera, optimizer.photometric, static_cast<int>(index));
  add_keyframe_priors(state, index, make_window_priors(window, optimizer), system);

  WindowSystem reduced;
  reduce_system(system, 0.0, reduced.H, reduced.g);
  reduced.H *= options.weight;
  reduced.g *= options.weight;
  add_marginal_prior(window, whole, reduced);

  // The gradient was computed at the current state; the prior is expressed relative to its linearisation.
  Eigen::VectorXd x = Eigen::VectorXd::Zero(reduced.g.size());
  MarginalPrior prior;
  std::vector<Eigen::Index> out;
  for (std::size_t k = 0; k < n; ++k) {
    const int known = window.prior.find(window.keyframes[k].get());
    MarginalPrior::Frame frame{window.keyframes[k], whole.poses[k].T_linearised, whole.brightness[k]};
    if (known >= 0) frame.brightness = window.prior.frames[static_cast<std::size_t>(known)].brightness;
    const auto p = static_cast<Eigen::Index>(8 * k);
    x.segment<8>(p) = marginal_deviation(frame, whole.poses[k].T_world_camera, whole.brightness[k]);
    const bool said = reduced.H.block<8, 8>(p, p).diagonal().maxCoeff() > 0.0;
    if (k == index || !said) {
      for (Eigen::Index i = 0; i < 8; ++i) out.push_back(p + i);
    } else {
      prior.frames.push_back(frame);
    }
  }
  for (auto i = static_cast<Eigen::Index>(8 * n); i < reduced.g.size(); ++i) out.push_back(i);
  reduced.g -= reduced.H * x;
  if (!prior.frames.empty()) {
    marginalize(reduced.H, reduced.g, out);
    prior.H = reduced.H;
    prior.g = reduced.g;
  }
  const bool finite = prior.H.allFinite() && prior.g.allFinite();
  window.prior = finite ? prior : MarginalPrior();
  translate(window, origin);
  window.keyframes.erase(window.keyframes.begin() + static_cast<std::ptrdiff_t>(index));
}

}  // namespace odosplat
