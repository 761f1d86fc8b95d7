// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <algorithm>
#include <cmath>

#include "kernels/constants.h"
#include "tests/splat/reference/dual.hpp"
#include "tests/splat/reference/raster_reference.hpp"

namespace odosplat::reference {
namespace {

using D = Dual<projection_inputs>;
using Vector3 = std::array<D, 3>;
using Matrix3 = std::array<Vector3, 3>;

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
  }
  return c;
}
Matrix3 transposed(const Matrix3& a) {
  Matrix3 t;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) t[i][j] = a[j][i];
  }
  return t;
}
Vector3 product(const Matrix3& a, const Vector3& x) {
  Vector3 y;
  for (std::size_t i = 0; i < 3; ++i) y[i] = a[i][0] * x[0] + a[i][1] * x[1] + a[i][2] * x[2];
  return y;
}

Matrix3 rotation_of(const D& w, const D& x, const D& y, const D& z) {
  return {{{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)},
           {2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)},
           {2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)}}};
}

// Real spherical harmonics from their definition: K_lm P_l|m|(cos) times sqrt(2) cos or sin of |m| phi, with the
// Condon-Shortley phase in P. (sin theta)^|m| cos, sin(|m| phi) = Re, Im (x + i y)^|m|, which keeps it polynomial.
std::vector<D> sh_basis(int degree, const Vector3& n) {
  std::vector<D> basis;
  const double pi = std::acos(-1.0);
  for (int l = 0; l <= degree; ++l) {
    for (int m = -l; m <= l; ++m) {
      const int order = std::abs(m);
      // P_l^m / (1 - z^2)^(m/2) by the recurrence over l.
      D p_mm = 1.0;
      for (int k = 1; k <= order; ++k) p_mm = p_mm * (-(2.0 * k - 1.0));
      D p = p_mm;
      if (l > order) {
        D before = p_mm;
        p = n[2] * (2.0 * order + 1.0) * p_mm;
        for (int k = order + 2; k <= l; ++k) {
          const D next = (n[2] * (2.0 * k - 1.0) * p - (k + order - 1.0) * before) / (1.0 * (k - order));
          before = p;
          p = next;
        }
      }
      D re = 1.0, im = 0.0;
      for (int k = 0; k < order; ++k) {
        const D next = re * n[0] - im * n[1];
        im = re * n[1] + im * n[0];
        re = next;
      }
      double ratio = 1.0;  // (l + |m|)! / (l - |m|)!
      for (int k = l - order + 1; k <= l + order; ++k) ratio *= k;
      const double norm = std::sqrt((2.0 * l + 1.0) / (4.0 * pi) / ratio) * (m == 0 ? 1.0 : std::sqrt(2.0));
      basis.push_back(norm * p * (m < 0 ? im : re));
    }
  }
  return basis;
}

bool uses_ray_plane(const RasterizerOptions& options, const RenderRequest& request) {
  if (options.depth_kind != DepthKind::automatic) return options.depth_kind == DepthKind::ray_plane;
  return request.depth_mode != DepthMode::blended;
}

D clamped(const D& x, double low, double high) {
  if (x.value < low) return low;
  return x.value > high ? D(high) : x;
}

Splat project_one(const Scene& scene, std::size_t g, const Camera& camera, const SE3& T_world_camera,
                  const RasterizerOptions& options, const RenderRequest& request) {
  const auto input = [&](const std::vector<double>& from, std::size_t stride, std::size_t i, std::size_t index) {
    return D::input(from[stride * g + i], index);
  };
  Vector3 position, scale;
  for (std::size_t i = 0; i < 3; ++i) {
    position[i] = input(scene.positions, 3, i, i);
    scale[i] = exp(input(scene.log_scales, 3, i, 3 + i));
  }
  std::array<D, 4> q;
  D norm2 = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    q[i] = input(scene.rotations, 4, i, 6 + i);
    norm2 = norm2 + q[i] * q[i];
  }
  const D norm = sqrt(norm2);
  const Matrix3 R = rotation_of(q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm);

  // exp(xi) T_camera_world at xi = 0, to first order.
  const SE3 T_camera_world = T_world_camera.inverse();
  const Eigen::Matrix3d R0 = T_camera_world.rotation_matrix();
  std::array<D, 3> rho, theta;
  for (std::size_t i = 0; i < 3; ++i) {
    rho[i] = D::input(0.0, 11 + i);
    theta[i] = D::input(0.0, 14 + i);
  }
  const Matrix3 turn = {{{1.0, -theta[2], theta[1]}, {theta[2], 1.0, -theta[0]}, {-theta[1], theta[0], 1.0}}};
  Matrix3 W;
  Vector3 t;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) W[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = R0(i, j);
    t[static_cast<std::size_t>(i)] = T_camera_world.translation()[i];
  }
  W = product(turn, W);
  t = product(turn, t);
  for (std::size_t i = 0; i < 3; ++i) t[i] = t[i] + rho[i];

  Vector3 p = product(W, position);
  for (std::size_t i = 0; i < 3; ++i) p[i] = p[i] + t[i];
  const D z = p[2];
  Splat splat;
  if (!(norm.value > 0.0) || !(z.value >= static_cast<double>(NEAR_DEPTH))) return splat;

  Matrix3 M = R;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) M[i][j] = R[i][j] * scale[j];
  }
  const Matrix3 covariance = product(W, product(product(M, transposed(M)), transposed(W)));

  const double margin_x = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.width / camera.fx;
  const double margin_y = static_cast<double>(JACOBIAN_MARGIN) * 0.5 * camera.height / camera.fy;
  const D tx = clamped(p[0] / z, (-0.5 - camera.cx) / camera.fx - margin_x,
                       (camera.width - 0.5 - camera.cx) / camera.fx + margin_x);
  const D ty = clamped(p[1] / z, (-0.5 - camera.cy) / camera.fy - margin_y,
                       (camera.height - 0.5 - camera.cy) / camera.fy + margin_y);
  const std::array<Vector3, 2> J = {
      {{camera.fx / z, 0.0, -camera.fx * tx / z}, {0.0, camera.fy / z, -camera.fy * ty / z}}};
  std::array<Vector3, 2> JS;  // J covariance
  for (std::size_t i = 0; i < 2; ++i) JS[i] = product(covariance, J[i]);
  const auto dot = [](const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const D a = dot(JS[0], J[0]), b = dot(JS[0], J[1]), c = dot(JS[1], J[1]);

  const D dilation = static_cast<double>(options.dilation);
  const D det = (a + dilation) * (c + dilation) - b * b;
  const D det_before = a * c - b * b;
  D log_opacity = -log(1.0 + exp(-D::input(scene.opacity_logits[g], 10)));
  if (options.compensated) {
    const D visibility = det_before / det;
    const double floor = static_cast<double>(COMPENSATION_FLOOR);
    log_opacity = log_opacity + 0.5 * log(visibility.value > floor ? visibility : D(floor));
  }
  D slope_u = 0.0, slope_v = 0.0;
  if (uses_ray_plane(options, request)) {
    const double widening = static_cast<double>(PLANE_DILATION);
    const D along_u = JS[0][2], along_v = JS[1][2];  // cov(pixel, depth)
    const D plane_det = (a + widening) * (c + widening) - b * b;
    slope_u = ((c + widening) * along_u - b * along_v) / plane_det / z;
    slope_v = ((a + widening) * along_v - b * along_u) / plane_det / z;
  }

  // Direction from the camera's centre, -W^T t, to the Gaussian; it equals W^T p.
  Vector3 direction = product(transposed(W), p);
  const D length = sqrt(dot(direction, direction));
  for (D& x : direction) x = x / length;
  const int degree = std::min(request.sh_degree, scene.sh_degree);
  const std::vector<D> basis = sh_basis(degree, direction);
  const auto stored = static_cast<std::size_t>(sh_coefficients(scene.sh_degree));
  std::array<D, 3> color;
  for (std::size_t channel = 0; channel < 3; ++channel) {
    color[channel] = 0.5;
    for (std::size_t k = 0; k < basis.size(); ++k) {
      color[channel] = color[channel] + basis[k] * scene.sh[3 * (stored * g + k) + channel];
    }
    splat.lit[channel] = color[channel].value > 0.0;
    if (!splat.lit[channel]) color[channel] = 0.0;
  }
  for (std::size_t k = 0; k < basis.size(); ++k) splat.basis[k] = basis[k].value;

  const std::array<D, splat_values> values = {camera.fx * p[0] / z + camera.cx,
                                              camera.fy * p[1] / z + camera.cy,
                                              (c + dilation) / det,
                                              -b / det,
                                              (a + dilation) / det,
                                              log_opacity,
                                              z,
                                              slope_u,
                                              slope_v,
                                              color[0],
                                              color[1],
                                              color[2]};
  splat.far = options.order == BlendOrder::distance ? length.value : z.value;
  splat.drawn = true;
  for (std::size_t i = 0; i < splat_values; ++i) {
    splat.value[i] = values[i].value;
    splat.jacobian[i] = values[i].d;
    splat.drawn = splat.drawn && std::isfinite(values[i].value);
  }
  return splat;
}

}  // namespace

Scene::Scene(const Gaussians& g)
    : sh_degree(g.sh_degree),
      positions(g.positions.begin(), g.positions.end()),
      log_scales(g.log_scales.begin(), g.log_scales.end()),
      rotations(g.rotations.begin(), g.rotations.end()),
      opacity_logits(g.opacity_logits.begin(), g.opacity_logits.end()),
      sh(g.sh.begin(), g.sh.end()) {}

std::vector<Splat> project(const Scene& scene, const Camera& camera, const SE3& T_world_camera,
                           const RasterizerOptions& options, const RenderRequest& request) {
  std::vector<Splat> splats;
  for (std::size_t g = 0; g < scene.size(); ++g) {
    splats.push_back(project_one(scene, g, camera, T_world_camera, options, request));
  }
  return splats;
}

Gradients project_backward(const Scene& scene, const std::vector<Splat>& splats, const RenderRequest& request,
                           const std::vector<std::array<double, splat_values>>& splat_gradients) {
  Gradients out;
  out.scene.sh_degree = scene.sh_degree;
  out.scene.positions.resize(scene.positions.size());
  out.scene.log_scales.resize(scene.log_scales.size());
  out.scene.rotations.resize(scene.rotations.size());
  out.scene.opacity_logits.resize(scene.opacity_logits.size());
  out.scene.sh.resize(scene.sh.size());
  const auto stored = static_cast<std::size_t>(sh_coefficients(scene.sh_degree));
  const auto used = static_cast<std::size_t>(sh_coefficients(std::min(request.sh_degree, scene.sh_degree)));
  for (std::size_t g = 0; g < splats.size(); ++g) {
    if (!splats[g].drawn) continue;
    std::array<double, projection_inputs> input{};
    for (std::size_t i = 0; i < splat_values; ++i) {
      for (std::size_t j = 0; j < projection_inputs; ++j) {
        input[j] += splat_gradients[g][i] * splats[g].jacobian[i][j];
      }
    }
    for (std::size_t i = 0; i < 3; ++i) {
      out.scene.positions[3 * g + i] = input[i];
      out.scene.log_scales[3 * g + i] = input[3 + i];
    }
    for (std::size_t i = 0; i < 4; ++i) out.scene.rotations[4 * g + i] = input[6 + i];
    out.scene.opacity_logits[g] = input[10];
    for (std::size_t i = 0; i < 6; ++i) out.pose[static_cast<Eigen::Index>(i)] += input[11 + i];
    for (std::size_t k = 0; k < used; ++k) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        if (!splats[g].lit[channel]) continue;
        out.scene.sh[3 * (stored * g + k) + channel] = splats[g].basis[k] * splat_gradients[g][9 + channel];
      }
    }
  }
  return out;
}

}  // namespace odosplat::reference
