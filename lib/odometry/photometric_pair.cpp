// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/photometric_pair.hpp"

#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

/// Sums over the pattern of w x x^T with x = (gx, gy, c, 1, r); c = e^(a_t - a_h) (I_host - b_h).
struct PatternSums {
  float gxx = 0, gxy = 0, gyy = 0, gxc = 0, gyc = 0, gx = 0, gy = 0, cc = 0, c = 0, w = 0, gxr = 0, gyr = 0, cr = 0,
        r = 0;
};

}  // namespace

void PhotometricOptions::check() const {
  require(noise > 0.0, "photometric.noise", "positive");
  require(huber > 0.0, "photometric.huber", "positive");
  require(outlier >= huber, "photometric.outlier", "at least huber");
}

PairSystem evaluate_pair(const PhotometricPair& pair, const PhotometricOptions& options) {
  constexpr float margin = 1.5F;
  // Columns: host pose 6, target pose 6, c, 1 and, last, the residual.
  using Matrix15d = Eigen::Matrix<double, 15, 15>;
  Matrix15d S = Matrix15d::Zero();
  PairSystem out;
  const Camera& camera = pair.camera;
  const GradientImage& image = *pair.target;
  const Eigen::Matrix3d R_wh = pair.T_world_host.rotation_matrix();
  const Eigen::Vector3d t_wh = pair.T_world_host.translation();
  const Eigen::Matrix3d R_tw = pair.T_world_target.rotation_matrix().transpose();
  const Eigen::Matrix3d R_th = R_tw * R_wh;
  const Eigen::Vector3d t_th = R_tw * (t_wh - pair.T_world_target.translation());
  const auto gain = static_cast<float>(std::exp(pair.target_brightness.a - pair.host.a));
  const auto host_b = static_cast<float>(pair.host.b);
  const auto target_b = static_cast<float>(pair.target_brightness.b);
  const auto huber = static_cast<float>(options.huber);
  const auto noise2 = static_cast<float>(options.noise * options.noise);
  const float outlier_loss = huber * (static_cast<float>(options.outlier) - 0.5F * huber);
  const auto fx = static_cast<float>(camera.fx);
  const auto fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx);
  const auto cy = static_cast<float>(camera.cy);
  const float max_u = static_cast<float>(camera.width) - 1.0F - margin;
  const float max_v = static_cast<float>(camera.height) - 1.0F - margin;
  const float* data = image.ptr<float>();
  const auto step = static_cast<std::ptrdiff_t>(image.step1());
  double cost = 0.0;
  for (const WindowPoint& point : *pair.points) {
    const double distance = point.plane_world.D - point.plane_world.N.dot(t_wh);
    const Eigen::Vector3d m =
        options.planes_in_world ? Eigen::Vector3d(R_wh.transpose() * point.plane_world.N / distance) : point.m_host;
    const Eigen::Vector3d ray = camera.ray(point.u, point.v);
    const double q = m.dot(ray);
    // Homography of the plane: p_target ~ base + du col_u + dv col_v.
    const Eigen::Vector3d base = R_th * ray + t_th * q;
    if (!(q > 1e-4) || !(base.z() > 1e-3)) {
      ++out.outside;
      continue;
    }
    const Eigen::Vector3f h = base.cast<float>();
    const Eigen::Vector3f col_u = (R_th.col(0) / camera.fx + t_th * (m.x() / camera.fx)).cast<float>();
    const Eigen::Vector3f col_v = (R_th.col(1) / camera.fy + t_th * (m.y() / camera.fy)).cast<float>();
    float u[pattern_size];
    float v[pattern_size];
    bool inside = true;
    for (std::size_t k = 0; k < pattern_size; ++k) {
      const auto du = static_cast<float>(pattern[k][0]);
      const auto dv = static_cast<float>(pattern[k][1]);
      const float z = h.z() + du * col_u.z() + dv * col_v.z();
      const float rz = 1.0F / z;
      u[k] = fx * (h.x() + du * col_u.x() + dv * col_v.x()) * rz + cx;
      v[k] = fy * (h.y() + du * col_u.y() + dv * col_v.y()) * rz + cy;
      inside = inside && z > 1e-3F && u[k] >= margin && v[k] >= margin && u[k] <= max_u && v[k] <= max_v;
    }
    if (!inside) {
      ++out.outside;
      continue;
    }
    // Geometry at the centre, in world coordinates: rows d(u, v) / d(point).
    const Eigen::Vector3d direction = R_wh * ray;
    const Eigen::Vector3d P = t_wh + direction / q;
    const double rz = q / base.z();
    const double x = base.x() / base.z();
    const double y = base.y() / base.z();
    Eigen::Matrix<double, 2, 3> G;
    G.row(0) = camera.fx * rz * (R_tw.row(0) - x * R_tw.row(2));
    G.row(1) = camera.fy * rz * (R_tw.row(1) - y * R_tw.row(2));
    const Eigen::Vector2d flow_by_q = G * direction * (-1.0 / (q * q));
    const auto du_sigma = static_cast<float>(flow_by_q.x() * point.sigma);
    const auto dv_sigma = static_cast<float>(flow_by_q.y() * point.sigma);

    PatternSums s;
    float loss = 0.0F;
    float limit = 0.0F;
    float squares = 0.0F;
    for (std::size_t k = 0; k < pattern_size; ++k) {
      const GradientSample target = sample(data, step, u[k], v[k]);
      const float gx = target.gx;
      const float gy = target.gy;
      const float c = gain * (point.intensity[k] - host_b);
      const float r = target.value - target_b - c;
      const float by_depth = gx * du_sigma + gy * dv_sigma;
      const float base_weight = point.weight[k] * noise2 / (noise2 + by_depth * by_depth);
      const float size = std::abs(r);
      const bool inner = size <= huber;
      loss += base_weight * (inner ? 0.5F * r * r : huber * (size - 0.5F * huber));
      limit += base_weight * outlier_loss;
      squares += r * r;
      const float w = inner ? base_weight : base_weight * huber / size;
      const float wgx = w * gx;
      const float wgy = w * gy;
      const float wc = w * c;
      s.gxx += wgx * gx;
      s.gxy += wgx * gy;
      s.gyy += wgy * gy;
      s.gxc += wgx * c;
      s.gyc += wgy * c;
      s.gx += wgx;
      s.gy += wgy;
      s.cc += wc * c;
      s.c += wc;
      s.w += w;
      s.gxr += wgx * r;
      s.gyr += wgy * r;
      s.cr += wc * r;
      s.r += w * r;
    }
    if (!(loss < limit)) {
      ++out.outliers;
      cost += limit;
      continue;
    }
    ++out.inliers;
    out.squares += squares / pattern_size;
    cost += loss;
    // Eq. in the header: rows of dP act on g as g - N (v . g) / (N . v); [I | -[P]x]^T g = (g, P x g).
    const double facing = q * distance;  // N . v
    Eigen::Matrix<double, 2, 12> J;
    for (int row = 0; row < 2; ++row) {
      const Eigen::Vector3d g = G.row(row).transpose();
      Eigen::Vector3d g_host = g;
      if (options.planes_in_world) g_host -= point.plane_world.N * (direction.dot(g) / facing);
      J.block<1, 3>(row, 0) = g_host.transpose();
      J.block<1, 3>(row, 3) = P.cross(g_host).transpose();
      J.block<1, 3>(row, 6) = -g.transpose();
      J.block<1, 3>(row, 9) = -P.cross(g).transpose();
    }
    Eigen::Matrix<double, 2, 5> M;  // gradient rows of the pattern sums against (gx, gy, c, 1, r)
    M << s.gxx, s.gxy, s.gxc, s.gx, s.gxr, s.gxy, s.gyy, s.gyc, s.gy, s.gyr;
    const Eigen::Matrix<double, 12, 2> JM = J.transpose() * M.leftCols<2>();
    for (int col = 0; col < 12; ++col) S.col(col).head<12>() += JM * J.col(col);
    S.block<12, 3>(0, 12) += J.transpose() * M.rightCols<3>();
    S(12, 12) += s.cc;
    S(12, 13) += s.c;
    S(13, 13) += s.w;
    S(12, 14) += s.cr;
    S(13, 14) += s.r;
  }
  // Brightness derivatives in terms of the columns c and 1: dr/da_h = c, dr/db_h = gain, dr/da_t = -c, dr/db_t = -1.
  const double scale = pair.weight / (options.noise * options.noise);
  S.block<3, 12>(12, 0) = S.block<12, 3>(0, 12).transpose();
  S(13, 12) = S(12, 13);
  Eigen::Matrix<double, 14, 16> L = Eigen::Matrix<double, 14, 16>::Zero();
  L.block<6, 6>(0, 0).setIdentity();
  L.block<6, 6>(6, 8).setIdentity();
  L(12, 6) = 1.0;
  L(13, 7) = static_cast<double>(gain);
  L(12, 14) = -1.0;
  L(13, 15) = -1.0;
  out.H = scale * (L.transpose() * S.topLeftCorner<14, 14>() * L);
  out.g = scale * (L.transpose() * S.topRightCorner<14, 1>());
  out.cost = scale * cost;
  return out;
}

}  // namespace odosplat
