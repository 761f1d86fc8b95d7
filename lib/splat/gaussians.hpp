// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <vector>

namespace odosplat {

/// Coefficients of one colour channel of spherical harmonics of a degree: (degree + 1)^2.
constexpr int sh_coefficients(int degree) { return (degree + 1) * (degree + 1); }

/// A set of N 3-D Gaussians on the host, as they are trained and stored: every attribute unconstrained.
/// Source: Kerbl et al. 2023. All arrays are flat, Gaussian after Gaussian, in float32.
///   positions       [N x 3]      world frame [m]
///   log_scales      [N x 3]      ln of the standard deviations along the Gaussian's own axes [ln m]
///   rotations       [N x 4]      w x y z, world <- own axes, of any length but zero (a Gaussian of length 0 is not
///   drawn) opacity_logits  [N]          opacity = 1 / (1 + exp(-logit)) sh              [N x K x 3]  colour = max(0,
///   0.5 + sum_k basis_k(direction) sh[k]), K = sh_coefficients(sh_degree);
///                                direction: unit vector, world frame, from the camera to the Gaussian
/// An empty set is valid. check() throws InputError if sizes disagree or sh_degree is outside 0..3.
struct Gaussians {
  int sh_degree = 0;
  std::vector<float> positions;
  std::vector<float> log_scales;
  std::vector<float> rotations;
  std::vector<float> opacity_logits;
  std::vector<float> sh;

  std::size_t size() const { return opacity_logits.size(); }
  bool empty() const { return opacity_logits.empty(); }
  int coefficients() const { return sh_coefficients(sh_degree); }
  void resize(std::size_t n);
  void check() const;
};

}  // namespace odosplat
