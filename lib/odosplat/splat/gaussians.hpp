// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace odosplat {

/// Basis function of degree 0 of the spherical harmonics: colour = sh_constant * sh + 0.5. SH_0 of kernels/sh.cl.
inline constexpr float sh_constant = 0.28209479F;

/// Coefficients of one colour channel of spherical harmonics of a degree: (degree + 1)^2.
constexpr int sh_coefficients(int degree) { return (degree + 1) * (degree + 1); }

/// A set of N 3-D Gaussians on the host, as they are trained and stored: every attribute unconstrained.
/// Source: Kerbl et al. 2023. All arrays are flat, Gaussian after Gaussian, in float32.
///   positions       [N x 3]      world frame [m]
///   log_scales      [N x 3]      ln of the standard deviations along the Gaussian's own axes [ln m]
///   rotations       [N x 4]      w x y z, world <- own axes, of any length but zero
///                                (a Gaussian of length 0 is not drawn)
///   opacity_logits  [N]          opacity = 1 / (1 + exp(-logit))
///   sh              [N x K x 3]  colour = max(0, 0.5 + sum_k basis_k(direction) sh[k]),
///                                K = sh_coefficients(sh_degree);
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

/// The largest values that the kernels' single precision can carry; a Gaussian beyond one of them is never drawn, or
/// spoils the pixels that it touches.
namespace gaussian_limits {
/// Of a coordinate [m]: the spacing of floats is 1 m there, and nothing is drawn at 1e6 m from the camera or farther.
constexpr float place = 1e7F;
/// Of a standard deviation [ln m]: 1e6 m. Its projection is (f e^s / z)^4 in a determinant, which overflows at
/// f e^s / z = 4e9.
constexpr float log_scale = 13.8156F;
/// Of the length of a quaternion, which is squared: with 1e-15 .. 1e15 the square and its inverse stay within the range
/// of floats (1e-38 .. 3e38).
constexpr float least_rotation = 1e-15F;
constexpr float rotation = 1e15F;
/// Of a coefficient of colour: the spacing of floats is a quarter of a grey level (of 255) there, so that a sum with
/// smaller colours loses them.
constexpr float color = 1e4F;
}  // namespace gaussian_limits

/// Why no device can draw Gaussian i of `gaussians`, all of whose values are finite: "its rotation has length 0"; empty
/// if it can be drawn. An opacity logit may be any number (the opacity approaches 0 or 1), and a size may be as small
/// as one likes.
std::string undrawable_value(const Gaussians& gaussians, std::size_t i);

}  // namespace odosplat
