// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/turned.hpp"

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace odosplat {
namespace {

constexpr std::size_t most_coefficients = 16;

/// Which axes a basis function of kernels/sh.cl is odd in: bit 0 for x, 1 for y, 2 for z.
constexpr std::array<std::uint8_t, most_coefficients> odd_axes{0, 2, 4, 1, 3, 6, 0, 5, 0, 2, 7, 2, 4, 1, 4, 1};

/// The basis functions of kernels/sh.cl in the direction d, of unit length.
Eigen::VectorXd sh_basis_at(int degree, const Eigen::Vector3d& d) {
  const double x = d.x();
  const double y = d.y();
  const double z = d.z();
  const double xx = x * x;
  const double yy = y * y;
  const double zz = z * z;
  constexpr double a = 1.0925484305920792;
  constexpr double b = 0.5900435899266435;
  constexpr double c = 0.4570457994644658;
  Eigen::VectorXd basis(16);
  basis << 0.28209479177387814, -0.4886025119029199 * y, 0.4886025119029199 * z, -0.4886025119029199 * x, a * x * y,
      -a * y * z, 0.31539156525252005 * (2 * zz - xx - yy), -a * x * z, 0.5 * a * (xx - yy), -b * y * (3 * xx - yy),
      2.890611442640554 * x * y * z, -c * y * (4 * zz - xx - yy), 0.3731763325901154 * z * (2 * zz - 3 * xx - 3 * yy),
      -c * x * (4 * zz - xx - yy), 1.445305721320277 * z * (xx - yy), -b * x * (xx - 3 * yy);
  return basis.head(sh_coefficients(degree));
}

}  // namespace

void turn_by_half(Gaussians& gaussians, Axis axis) {
  const auto kept = static_cast<std::size_t>(axis);
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    for (std::size_t a = 0; a < 3; ++a) {
      if (a == kept) continue;
      float& position = gaussians.positions[3 * i + a];
      float& rotation = gaussians.rotations[4 * i + 1 + a];
      position = -position;
      rotation = -rotation;  // the axes of the Gaussian turn about the same axis: their directions do not matter
    }
  }
  const unsigned turned = 7U & ~(1U << kept);
  const auto k = static_cast<std::size_t>(gaussians.coefficients());
  for (std::size_t j = 0; j < k; ++j) {
    const unsigned odd = odd_axes[j] & turned;
    if (odd == 0 || odd == turned) continue;  // odd in neither or both of the axes that change their sign
    for (std::size_t i = 0; i < gaussians.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        float& value = gaussians.sh[3 * (k * i + j) + c];
        value = -value;
      }
    }
  }
}

Eigen::MatrixXd sh_rotation(int degree, const Eigen::Matrix3d& R_target_source) {
  // The colour seen in a direction of the target is that of the source in the direction rotated back. Both are sums of
  // the same basis functions, so that directions enough to tell these apart determine the matrix.
  constexpr int directions = 64;
  const int k = sh_coefficients(degree);
  Eigen::MatrixXd in_target(directions, k);
  Eigen::MatrixXd in_source(directions, k);
  for (int i = 0; i < directions; ++i) {  // on a spiral from pole to pole
    const double z = 1.0 - (2.0 * i + 1.0) / directions;
    const double angle = 2.399963229728653 * i;
    const double radius = std::sqrt(1.0 - z * z);
    const Eigen::Vector3d direction(radius * std::cos(angle), radius * std::sin(angle), z);
    in_target.row(i) = sh_basis_at(degree, direction).transpose();
    in_source.row(i) = sh_basis_at(degree, R_target_source.transpose() * direction).transpose();
  }
  return in_target.colPivHouseholderQr().solve(in_source);
}

void move_gaussians(Gaussians& gaussians, const Similarity& T_target_source) {
  const Eigen::Quaterniond& R = T_target_source.T_target_source.rotation();
  const Eigen::Quaternionf q_target_source = R.cast<float>();
  const auto log_scale = static_cast<float>(std::log(T_target_source.scale));
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    Eigen::Map<Eigen::Vector3f> position(&gaussians.positions[3 * i]);
    position = (T_target_source * Eigen::Vector3d(position.cast<double>())).cast<float>();
    float* rotation = &gaussians.rotations[4 * i];
    const Eigen::Quaternionf turned =
        q_target_source * Eigen::Quaternionf(rotation[0], rotation[1], rotation[2], rotation[3]);
    rotation[0] = turned.w();
    rotation[1] = turned.x();
    rotation[2] = turned.y();
    rotation[3] = turned.z();
    for (std::size_t a = 0; a < 3; ++a) gaussians.log_scales[3 * i + a] += log_scale;
  }
  if (gaussians.sh_degree == 0) return;
  const Eigen::MatrixXf turn = sh_rotation(gaussians.sh_degree, R.toRotationMatrix()).cast<float>();
  const Eigen::Index k = turn.rows();
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>> sh(
        &gaussians.sh[3 * static_cast<std::size_t>(k) * i], k, 3);
    sh = (turn * sh).eval();
  }
}

}  // namespace odosplat
