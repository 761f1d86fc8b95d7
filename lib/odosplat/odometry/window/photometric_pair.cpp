// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/window/photometric_pair.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

using Array8f = Eigen::Array<float, pattern_size, 1>;
using Vector12f = Eigen::Matrix<float, 12, 1>;
using Vector16f = Eigen::Matrix<float, 16, 1>;

/// Sums over the pattern of w x x^T with x = (gx, gy, c, 1, r); c = e^(a_t - a_h) (I_host - b_h).
struct PatternSums {
  float gxx, gxy, gyy, gxc, gyc, gx, gy, cc, c, w, gxr, gyr, cr, r;
  float loss, limit, squares;
};

/// Where the pattern falls in the target.
struct WarpedPattern {
  Array8f u, v;
  bool inside;
};

/// Sums over many points. Rows of S: host pose 6, target pose 6; columns: the same, then c, 1, the residual and one
/// that is not used. Only blocks of 4 x 4 on and right of the diagonal are filled.
struct PairSums {
  Eigen::Matrix<float, 12, 16, Eigen::RowMajor> S = Eigen::Matrix<float, 12, 16, Eigen::RowMajor>::Zero();
  float cc = 0, c = 0, w = 0, cr = 0, r = 0;
  float cost = 0, squares = 0;

  void add(const PatternSums& s, const Vector12f& Ju, const Vector12f& Jv) {
    Vector16f Au;
    Vector16f Av;
    Au << s.gxx * Ju + s.gxy * Jv, s.gxc, s.gx, s.gxr, 0.0F;
    Av << s.gxy * Ju + s.gyy * Jv, s.gyc, s.gy, s.gyr, 0.0F;
    for (int i = 0; i < 4; ++i) S.row(i) += (Ju[i] * Au + Jv[i] * Av).transpose();
    for (int i = 4; i < 8; ++i) {
      S.row(i).tail<12>() += (Ju[i] * Au.tail<12>() + Jv[i] * Av.tail<12>()).transpose();
    }
    for (int i = 8; i < 12; ++i) {
      S.row(i).tail<8>() += (Ju[i] * Au.tail<8>() + Jv[i] * Av.tail<8>()).transpose();
    }
    cc += s.cc;
    c += s.c;
    w += s.w;
    cr += s.cr;
    r += s.r;
    cost += s.loss;
    squares += s.squares / pattern_size;
  }
};

/// The same in double precision, with rows for c and 1 too; the lower triangle is filled at the end.
struct TotalSums {
  Eigen::Matrix<double, 15, 15> S = Eigen::Matrix<double, 15, 15>::Zero();
  double cost = 0.0;
  double squares = 0.0;

  void add(const PairSums& s) {
    S.topLeftCorner<12, 15>() += s.S.leftCols<15>().cast<double>();
    S(12, 12) += s.cc;
    S(12, 13) += s.c;
    S(13, 13) += s.w;
    S(12, 14) += s.cr;
    S(13, 14) += s.r;
    cost += s.cost;
    squares += s.squares;
  }
};

/// Constants of a pair in single precision.
struct PairConstants {
  float gain, host_b, target_b, huber, noise2, outlier_loss, fx, fy, cx, cy, margin, max_u, max_v;
};

WarpedPattern warp_pattern(const Eigen::Vector3f& base, const Eigen::Vector3f& col_u, const Eigen::Vector3f& col_v,
                           const PairConstants& k) {
  static_assert(pattern_size == 8);
  Array8f du;
  Array8f dv;
  for (int i = 0; i < pattern_size; ++i) {
    du[i] = static_cast<float>(pattern[static_cast<std::size_t>(i)][0]);
    dv[i] = static_cast<float>(pattern[static_cast<std::size_t>(i)][1]);
  }
  WarpedPattern w;
  const Array8f z = base.z() + du * col_u.z() + dv * col_v.z();
  const Array8f rz = 1.0F / z;
  w.u = k.fx * (base.x() + du * col_u.x() + dv * col_v.x()) * rz + k.cx;
  w.v = k.fy * (base.y() + du * col_u.y() + dv * col_v.y()) * rz + k.cy;
  const Array8f room = (w.u - k.margin).min(k.max_u - w.u).min((w.v - k.margin).min(k.max_v - w.v)).min(z - 1e-3F);
  w.inside = room.minCoeff() >= 0.0F;
  return w;
}

/// flow_sigma: image motion [px] of one standard deviation of inverse depth.
PatternSums sum_pattern(const WindowPoint& point, const WarpedPattern& at, const Eigen::Vector2f& flow_sigma,
                        const float* data, std::ptrdiff_t step, const PairConstants& k) {
  Array8f value;
  Array8f gx;
  Array8f gy;
  for (int i = 0; i < pattern_size; ++i) {
    const int x = static_cast<int>(at.u[i]);
    const int y = static_cast<int>(at.v[i]);
    const float a = at.u[i] - static_cast<float>(x);
    const float b = at.v[i] - static_cast<float>(y);
    const float* r0 = data + y * step + 4 * x;
    const Eigen::Map<const Eigen::Array4f> p00(r0);
    const Eigen::Map<const Eigen::Array4f> p10(r0 + 4);
    const Eigen::Map<const Eigen::Array4f> p01(r0 + step);
    const Eigen::Map<const Eigen::Array4f> p11(r0 + step + 4);
    const float ab = a * b;
    const Eigen::Array4f s = (1.0F - a - b + ab) * p00 + (a - ab) * p10 + (b - ab) * p01 + ab * p11;
    value[i] = s[0];
    gx[i] = s[1];
    gy[i] = s[2];
  }
  const Eigen::Map<const Array8f> intensity(point.intensity);
  const Eigen::Map<const Array8f> weight(point.weight);
  const Array8f c = k.gain * (intensity - k.host_b);
  const Array8f expected = k.target_b + c;
  // Clipped, as it is expected to be, in either image: residual and weight are 0.
  const auto white = (value >= clipped_value && expected >= value) || (intensity >= clipped_value && value >= expected);
  const Array8f r = white.select(0.0F, value - expected);
  const Array8f by_depth = gx * flow_sigma.x() + gy * flow_sigma.y();
  const Array8f base = white.select(0.0F, weight * (k.noise2 / (k.noise2 + by_depth * by_depth)));
  const Array8f size = r.abs();
  const Array8f inner = size.min(k.huber);
  const Array8f w = base * (k.huber / size.max(k.huber));
  const Array8f wgx = w * gx;
  const Array8f wgy = w * gy;
  const Array8f wc = w * c;
  PatternSums s;
  s.loss = (base * inner * (size - 0.5F * inner)).sum();
  s.limit = base.sum() * k.outlier_loss;
  s.squares = (r * r).sum();
  s.gxx = (wgx * gx).sum();
  s.gxy = (wgx * gy).sum();
  s.gyy = (wgy * gy).sum();
  s.gxc = (wgx * c).sum();
  s.gyc = (wgy * c).sum();
  s.gx = wgx.sum();
  s.gy = wgy.sum();
  s.cc = (wc * c).sum();
  s.c = wc.sum();
  s.w = w.sum();
  s.gxr = (wgx * r).sum();
  s.gyr = (wgy * r).sum();
  s.cr = (wc * r).sum();
  s.r = (w * r).sum();
  return s;
}

}  // namespace

void PhotometricOptions::check() const {
  require(noise > 0.0, "photometric.noise", "positive");
  require(huber > 0.0, "photometric.huber", "positive");
  require(outlier >= huber, "photometric.outlier", "at least huber");
}

std::vector<HostPoint> make_host_points(std::span<const WindowPoint> points, std::span<const double> offsets,
                                        const Camera& camera, const PoseEstimate& host) {
  std::vector<HostPoint> out(points.size());
  const Eigen::Matrix3d R = host.T_world_camera.rotation_matrix();
  const Eigen::Vector3d t = host.T_world_camera.translation();
  const Eigen::Matrix3d R_linearised = host.T_linearised.rotation_matrix();
  const Eigen::Vector3d t_linearised = host.T_linearised.translation();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const WindowPoint& point = points[i];
    HostPoint& p = out[i];
    const double offset = offsets.empty() ? point.offset : offsets[i];
    const Plane& plane = point.plane_world;
    p.ray = camera.ray(point.u, point.v);
    Eigen::Vector3d m = point.m_host;
    if (point.plane_in_world) m = R.transpose() * plane.N / (plane.D - plane.N.dot(t));
    m.z() += offset;
    p.m = m.cast<float>();
    p.q = m.dot(p.ray);
    p.v = R_linearised * p.ray;
    p.q_by_host.setZero();
    if (point.plane_in_world) {
      const double distance = plane.D - plane.N.dot(t_linearised);
      const double q_plane = plane.N.dot(p.v) / distance;
      const Eigen::Vector3d on_plane = t_linearised + p.v / q_plane;
      p.q_by_host << plane.N, on_plane.cross(plane.N);
      p.q_by_host *= q_plane / distance;
      p.q_linearised = q_plane + offset;
    } else {
      p.q_linearised = p.q;
    }
    p.P = t_linearised + p.v / p.q_linearised;
    if (!(p.q > 1e-4) || !(p.q_linearised > 1e-4)) p.q = 0.0;
  }
  return out;
}

PairSystem evaluate_pair(const PhotometricPair& pair, const PhotometricOptions& options,
                         std::span<DepthTerms> depth_terms) {
  constexpr float margin = 1.5F;
  constexpr int block = 32;
  PairSystem out;
  const Camera& camera = pair.camera;
  const GradientImage& image = *pair.target;
  const Eigen::Matrix3d R_tw = pair.target_pose.T_world_camera.rotation_matrix().transpose();
  const Eigen::Matrix3d R_th = R_tw * pair.host.T_world_camera.rotation_matrix();
  const Eigen::Vector3d t_th =
      R_tw * (pair.host.T_world_camera.translation() - pair.target_pose.T_world_camera.translation());
  const Eigen::Matrix3d R_tw_linearised = pair.target_pose.T_linearised.rotation_matrix().transpose();
  const Eigen::Vector3d t_wt_linearised = pair.target_pose.T_linearised.translation();
  const bool linearised_elsewhere = pair.host.fixed || pair.target_pose.fixed;
  const auto huber = static_cast<float>(options.huber);
  const PairConstants k{static_cast<float>(std::exp(pair.target_brightness.a - pair.host_brightness.a)),
                        static_cast<float>(pair.host_brightness.b),
                        static_cast<float>(pair.target_brightness.b),
                        huber,
                        static_cast<float>(options.noise * options.noise),
                        huber * (static_cast<float>(options.outlier) - 0.5F * huber),
                        static_cast<float>(camera.fx),
                        static_cast<float>(camera.fy),
                        static_cast<float>(camera.cx),
                        static_cast<float>(camera.cy),
                        margin,
                        static_cast<float>(camera.width) - 1.0F - margin,
                        static_cast<float>(camera.height) - 1.0F - margin};
  const double scale = pair.weight / (options.noise * options.noise);
  const float* data = image.ptr<float>();
  const auto step = static_cast<std::ptrdiff_t>(image.step1());
  const Eigen::Vector3f R_u = (R_th.col(0) / camera.fx).cast<float>();
  const Eigen::Vector3f R_v = (R_th.col(1) / camera.fy).cast<float>();
  const Eigen::Vector3f t_u = (t_th / camera.fx).cast<float>();
  const Eigen::Vector3f t_v = (t_th / camera.fy).cast<float>();
  TotalSums total;
  PairSums sums;
  int in_block = 0;
  for (std::size_t i = 0; i < pair.points.size(); ++i) {
    const WindowPoint& point = pair.points[i];
    const HostPoint& host = pair.host_points[i];
    // Homography of the plane: p_target ~ base + du col_u + dv col_v.
    const Eigen::Vector3d base = R_th * host.ray + t_th * host.q;
    if (!(host.q > 0.0) || !(base.z() > 1e-3)) {
      ++out.outside;
      continue;
    }
    const WarpedPattern at = warp_pattern(base.cast<float>(), R_u + t_u * host.m.x(), R_v + t_v * host.m.y(), k);
    if (!at.inside) {
      ++out.outside;
      continue;
    }
    // Geometry at the centre, in world coordinates: rows d(u, v) / d(point).
    Eigen::Vector3d centre = base;
    if (linearised_elsewhere) centre = R_tw_linearised * (host.P - t_wt_linearised) * host.q_linearised;
    const double rz = host.q_linearised / centre.z();
    const double x = centre.x() / centre.z();
    const double y = centre.y() / centre.z();
    const Eigen::Vector3d gu = camera.fx * rz * (R_tw_linearised.row(0) - x * R_tw_linearised.row(2)).transpose();
    const Eigen::Vector3d gv = camera.fy * rz * (R_tw_linearised.row(1) - y * R_tw_linearised.row(2)).transpose();
    const double q2 = -1.0 / (host.q_linearised * host.q_linearised);
    const Eigen::Vector2d flow_by_q(gu.dot(host.v) * q2, gv.dot(host.v) * q2);
    const double sigma = point.estimated ? 0.0 : point.sigma;
    const PatternSums s = sum_pattern(point, at, (flow_by_q * sigma).cast<float>(), data, step, k);
    const bool wanted = point.estimated && !depth_terms.empty();
    if (!(s.loss < s.limit)) {
      ++out.outliers;
      sums.cost += s.limit;
      if (wanted) depth_terms[i].outlier = true;
      continue;
    }
    ++out.inliers;
    Eigen::Matrix<double, 6, 1> ju;
    Eigen::Matrix<double, 6, 1> jv;
    ju << gu, host.P.cross(gu);
    jv << gv, host.P.cross(gv);
    Vector12f Ju;
    Vector12f Jv;
    Ju << (ju + flow_by_q.x() * host.q_by_host).cast<float>(), -ju.cast<float>();
    Jv << (jv + flow_by_q.y() * host.q_by_host).cast<float>(), -jv.cast<float>();
    sums.add(s, Ju, Jv);
    if (wanted) {
      DepthTerms& d = depth_terms[i];
      d.inlier = true;
      const Eigen::Vector2f f = flow_by_q.cast<float>();
      const float fu = s.gxx * f.x() + s.gxy * f.y();
      const float fv = s.gxy * f.x() + s.gyy * f.y();
      const float by_c = f.x() * s.gxc + f.y() * s.gyc;
      const float by_1 = f.x() * s.gx + f.y() * s.gy;
      const auto scale_f = static_cast<float>(scale);
      d.H = scale * static_cast<double>(fu * f.x() + fv * f.y());
      d.g = scale * static_cast<double>(f.x() * s.gxr + f.y() * s.gyr);
      const Vector12f cross = scale_f * (fu * Ju + fv * Jv);
      d.cross << cross.head<6>(), scale_f * by_c, scale_f * by_1 * k.gain, cross.tail<6>(), -scale_f * by_c,
          -scale_f * by_1;
    }
    if (++in_block == block) {
      total.add(sums);
      sums = {};
      in_block = 0;
    }
  }
  total.add(sums);
  // Brightness derivatives in terms of the columns c and 1: dr/da_h = c, dr/db_h = gain, dr/da_t = -c, dr/db_t = -1.
  Eigen::Matrix<double, 15, 15>& S = total.S;
  for (Eigen::Index row = 1; row < 14; ++row) {
    for (Eigen::Index col = 0; col < row; ++col) S(row, col) = S(col, row);
  }
  Eigen::Matrix<double, 14, 16> L = Eigen::Matrix<double, 14, 16>::Zero();
  L.block<6, 6>(0, 0).setIdentity();
  L.block<6, 6>(6, 8).setIdentity();
  L(12, 6) = 1.0;
  L(13, 7) = static_cast<double>(k.gain);
  L(12, 14) = -1.0;
  L(13, 15) = -1.0;
  out.H = scale * (L.transpose() * S.topLeftCorner<14, 14>() * L);
  out.g = scale * (L.transpose() * S.topRightCorner<14, 1>());
  out.cost = scale * total.cost;
  out.squares = total.squares;
  return out;
}

}  // namespace odosplat
