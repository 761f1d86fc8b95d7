// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/splat/gaussians.hpp"
#include "odosplat/splat/raster/rasterizer.hpp"

/// Double-precision reference of the rasteriser (the twin): the same definitions, implemented for readability, without
/// tiles, sorting by parts, square roots of covariances or polynomials for exp. Every Gaussian is evaluated at every
/// pixel.
namespace odosplat::reference {

/// Gaussians in double; layouts as in odosplat::Gaussians.
struct Scene {
  int sh_degree = 0;
  std::vector<double> positions, log_scales, rotations, opacity_logits, sh;

  Scene() = default;
  explicit Scene(const Gaussians& g);
  std::size_t size() const { return opacity_logits.size(); }
};

/// Inputs of a Gaussian's projection: position 0..2, log scale 3..5, rotation 6..9, logit 10, pose twist 11..16.
constexpr std::size_t projection_inputs = 17;
/// Values of a splat for compositing: u, v, conic A B C (q = A dx^2 + 2 B dx dy + C dy^2), ln opacity, depth, slopes of
/// depth over u and v, red, green, blue.
constexpr std::size_t splat_values = 12;

struct Splat {
  bool drawn = false;
  double far = 0.0;  // sort key, smallest first
  std::array<double, splat_values> value{};
  /// d value[i] / d input[j].
  std::array<std::array<double, projection_inputs>, splat_values> jacobian{};
  /// Colour is linear in sh: d color[c] / d sh[k][c] = basis[k], 0 for a channel clamped at black.
  std::array<double, 16> basis{};
  std::array<bool, 3> lit{};
};

/// Definitions as in rasterizer.hpp. The twist is the left perturbation of T_camera_world, at 0.
std::vector<Splat> project(const Scene& scene, const Camera& camera, const SE3& T_world_camera,
                           const RasterizerOptions& options, const RenderRequest& request);

/// One Gaussian at one pixel, with the decisions that make the image discontinuous.
struct Contribution {
  std::size_t gaussian = 0;
  bool capped = false;   // alpha is limited to MAX_ALPHA
  bool bounded = false;  // depth is limited
  bool median = false;   // the transmittance falls below 0.5 here
};
/// For each pixel, from near to far.
using Decisions = std::vector<std::vector<Contribution>>;

/// Images as in RenderOutput. margin: how close a pixel is to a different decision (the smallest relative distance of
/// an alpha, a transmittance or a depth ratio to its threshold); where it is small, float and double may differ.
struct Images {
  int width = 0, height = 0;
  std::vector<double> color, depth, alpha, sigma, margin;
};

/// frozen: decisions to use instead of new ones (for finite differences). made: receives the decisions made.
Images composite(const std::vector<Splat>& splats, const Camera& camera, const RenderRequest& request,
                 const Decisions* frozen = nullptr, Decisions* made = nullptr);

/// dL/d(images); empty = none.
struct ImageGradients {
  std::vector<double> color, depth, alpha;
};

/// dL/d splat values, computed from the back of each pixel to its front.
std::vector<std::array<double, splat_values>> composite_backward(const std::vector<Splat>& splats, const Camera& camera,
                                                                 const RenderRequest& request,
                                                                 const Decisions& decisions,
                                                                 const ImageGradients& given);

struct Gradients {
  Scene scene;  // gradients of all attributes
  Vector6d pose = Vector6d::Zero();
};
Gradients project_backward(const Scene& scene, const std::vector<Splat>& splats, const RenderRequest& request,
                           const std::vector<std::array<double, splat_values>>& splat_gradients);

}  // namespace odosplat::reference
