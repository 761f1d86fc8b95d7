// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/sim3_icp.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "odosplat/cloud/local_planes.hpp"
#include "odosplat/cloud/neighbor_search.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/core/upper_median.hpp"

namespace odosplat {
namespace {

using Vector7d = Eigen::Matrix<double, 7, 1>;
using Matrix7d = Eigen::Matrix<double, 7, 7>;

constexpr double shrink = 0.9;        // factor on the radius per step
constexpr double open_below = 0.004;  // limit for `weakest`
constexpr double sigma_of_mad = 1.4826;
constexpr std::size_t fewest_points = 20;
constexpr std::size_t fewest_cloud_points = 100;
constexpr int chunk = 512;

// A point at its current position, and its nearest neighbour's plane.
struct Match {
  bool found = false;
  Eigen::Vector3d p = Eigen::Vector3d::Zero();  // [m] in the cloud's frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double distance = 0.0;  // [m] from the plane, signed
};

// At most `most` points, picked evenly from the whole list.
std::vector<Eigen::Vector3d> picked(const std::vector<Eigen::Vector3f>& points, int most) {
  const std::size_t n = std::min(points.size(), static_cast<std::size_t>(most));
  std::vector<Eigen::Vector3d> chosen(n);
  for (std::size_t i = 0; i < n; ++i) chosen[i] = points[i * points.size() / n].cast<double>();
  return chosen;
}

// Median distance of neighbours in the cloud [m], from at most 2000 of its points.
double spacing_of(const PointCloud& cloud, const NeighborSearch& search) {
  std::vector<double> distances;
  for (const Eigen::Vector3d& p : picked(cloud.points, 2000)) {
    int indices[2];
    float squares[2];
    if (search.nearest(p.cast<float>(), 2, indices, squares) == 2) {
      distances.push_back(std::sqrt(static_cast<double>(squares[1])));
    }
  }
  return upper_median(std::move(distances));
}

// Sums of J J^T and J r over matches, for parameters about `centre` with lengths in units of `extent`.
struct System {
  Matrix7d H = Matrix7d::Zero();
  Vector7d b = Vector7d::Zero();
  double weight = 0.0;

  void add(const Match& m, double w, const Eigen::Vector3d& centre, double extent) {
    const Eigen::Vector3d q = (m.p - centre) / extent;
    Vector7d J;
    J << m.normal, q.cross(m.normal), m.normal.dot(q);
    H += w * J * J.transpose();
    b += w * m.distance / extent * J;
    weight += w;
  }
};

double tukey(double distance, double width) {
  const double x = distance / width;
  if (std::abs(x) >= 1.0) return 0.0;
  return (1.0 - x * x) * (1.0 - x * x);
}

class Aligner {
 public:
  Aligner(const std::vector<Eigen::Vector3f>& points, const PointCloud& cloud, const Sim3IcpOptions& options)
      : options_(options),
        cloud_(cloud),
        points_(picked(points, options.max_points)),
        search_(cloud.points),
        planes_(fit_local_planes(cloud, options.neighbors)),
        last_radius_(2.0 * std::max(options.inlier, spacing_of(cloud, search_))) {}

  Sim3IcpResult run(const Similarity& guess) {
    Similarity S = guess;
    double radius = std::max(options_.radius, last_radius_);
    Sim3IcpResult result;
    while (result.iterations < options_.iterations && !result.converged) {
      ++result.iterations;
      const double moved = step(radius, S);
      if (!(moved < 1e3) || ran_away(guess, S)) break;
      result.converged = radius <= last_radius_ && moved < 0.01 * options_.inlier;
      radius = std::max(last_radius_, shrink * radius);
    }
    judge(guess, S, result);
    return result;
  }

 private:
  bool ran_away(const Similarity& guess, const Similarity& S) const {
    const double change = S.scale / guess.scale;
    return !(change <= options_.max_change && change >= 1.0 / options_.max_change);
  }

  void match(const Similarity& S, double radius) {
    matches_.resize(points_.size());
    const double square = radius * radius;
    parallel_for(static_cast<int>(points_.size()), chunk, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        Match& m = matches_[static_cast<std::size_t>(i)];
        m.p = S * points_[static_cast<std::size_t>(i)];
        int index = 0;
        float distance = 0.0F;
        m.found = m.p.cwiseAbs().maxCoeff() < 1e15 && search_.nearest(m.p.cast<float>(), 1, &index, &distance) == 1 &&
                  distance <= square;
        if (!m.found) continue;
        const auto at = static_cast<std::size_t>(index);
        m.normal = planes_[at].normal.cast<double>();
        m.distance = m.normal.dot(m.p - cloud_.points[at].cast<double>());
      }
    });
  }

  // Centre of the found matches and their rms distance from it; false if there are too few.
  bool frame_matches() {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double squares = 0.0;
    std::size_t n = 0;
    for (const Match& m : matches_) {
      if (!m.found) continue;
      sum += m.p;
      ++n;
    }
    if (n < fewest_points) return false;
    centre_ = sum / static_cast<double>(n);
    for (const Match& m : matches_) {
      if (m.found) squares += (m.p - centre_).squaredNorm();
    }
    extent_ = std::sqrt(squares / static_cast<double>(n));
    return extent_ > 1e-9;
  }

  template <typename Weight>
  System sum_up(Weight weight) const {
    const std::size_t n = matches_.size();
    std::vector<System> parts((n + chunk - 1) / chunk);
    parallel_for(static_cast<int>(n), chunk, [&](int begin, int end) {
      System& part = parts[static_cast<std::size_t>(begin / chunk)];
      for (int i = begin; i < end; ++i) {
        const Match& m = matches_[static_cast<std::size_t>(i)];
        if (!m.found) continue;
        const double w = weight(m);
        if (w > 0.0) part.add(m, w, centre_, extent_);
      }
    });
    System total;
    for (const System& part : parts) {
      total.H += part.H;
      total.b += part.b;
      total.weight += part.weight;
    }
    return total;
  }

  // Returns the distance [m] by which a point at the rms distance was moved; infinity if there are too few matches.
  double step(double radius, Similarity& S) {
    match(S, radius);
    if (!frame_matches()) return INFINITY;
    std::vector<double> distances;
    for (const Match& m : matches_) {
      if (m.found) distances.push_back(std::abs(m.distance));
    }
    const double sigma = sigma_of_mad * upper_median(std::move(distances));
    const double width = std::max(std::min(3.0 * sigma, radius), 0.5 * options_.inlier);
    System system = sum_up([width](const Match& m) { return tukey(m.distance, width); });
    if (!(system.weight > 0.0)) return INFINITY;
    // Regularisation: undetermined directions do not move.
    system.H.diagonal().array() += 1e-6 * system.weight;
    Vector7d x = -system.H.ldlt().solve(system.b);
    if (!x.allFinite()) return INFINITY;
    // Limited, because the linearisation is not valid for long steps.
    const double most = 0.2;
    if (const double length = x.norm(); length > most) x *= most / length;
    const double scale = std::exp(x[6]);
    const Eigen::Quaterniond R = so3_exp(x.segment<3>(3));
    const Eigen::Vector3d t = S.T_target_source.translation();
    S.scale *= scale;
    S.T_target_source =
        SE3(R * S.T_target_source.rotation(), centre_ + extent_ * x.head<3>() + scale * (R * (t - centre_)));
    return extent_ * x.norm();
  }

  void judge(const Similarity& guess, const Similarity& S, Sim3IcpResult& result) {
    result.cloud_from_points = S;
    result.points = static_cast<int>(points_.size());
    match(S, last_radius_);
    std::vector<double> distances;
    double squares = 0.0;
    for (Match& m : matches_) {
      m.found = m.found && std::abs(m.distance) <= options_.inlier;
      if (!m.found) continue;
      distances.push_back(std::abs(m.distance));
      squares += m.distance * m.distance;
    }
    result.inliers = static_cast<int>(distances.size());
    result.inlier_share = static_cast<double>(result.inliers) / static_cast<double>(result.points);
    if (frame_matches()) {
      result.rmse_m = std::sqrt(squares / static_cast<double>(result.inliers));
      result.median_m = upper_median(std::move(distances));
      const System system = sum_up([](const Match&) { return 1.0; });
      const Eigen::SelfAdjointEigenSolver<Matrix7d> solver(system.H / system.weight, Eigen::EigenvaluesOnly);
      result.weakest = solver.eigenvalues()[0];
    }
    result.fault = fault_of(guess, result);
  }

  std::string fault_of(const Similarity& guess, const Sim3IcpResult& r) const {
    if (ran_away(guess, r.cloud_from_points)) {
      return formatted("the scale runs away from %g to %g or beyond", guess.scale, r.cloud_from_points.scale);
    }
    if (!(r.inlier_share >= options_.min_inliers) || r.inliers < static_cast<int>(fewest_points)) {
      return formatted("only %.1f %% of %d points come to lie within %g m of the cloud, needed are %.0f %%",
                       100.0 * r.inlier_share, r.points, options_.inlier, 100.0 * options_.min_inliers);
    }
    if (!(r.weakest >= open_below)) {
      return formatted("the surfaces do not determine a direction, a rotation or the scale (%.4f < %.4f)", r.weakest,
                       open_below);
    }
    return r.converged ? "" : formatted("not converged after %d iterations", r.iterations);
  }

  Sim3IcpOptions options_;
  const PointCloud& cloud_;
  std::vector<Eigen::Vector3d> points_;
  NeighborSearch search_;
  std::vector<LocalPlane> planes_;
  double last_radius_;
  std::vector<Match> matches_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double extent_ = 1.0;  // [m]
};

}  // namespace

void Sim3IcpOptions::check() const {
  require(std::isfinite(radius) && radius > 0.0, "radius", "positive [m]");
  require(std::isfinite(inlier) && inlier > 0.0, "inlier", "positive [m]");
  require(min_inliers >= 0.0 && min_inliers <= 1.0, "min-inliers", "in 0..1");
  require(std::isfinite(max_change) && max_change > 1.0, "max-change", "more than 1");
  require(max_points >= 100, "max-points", "at least 100");
  require(neighbors >= 3, "neighbors", "at least 3");
  require(iterations >= 1, "iterations", "at least 1");
}

Sim3IcpResult align_to_cloud(const std::vector<Eigen::Vector3f>& points, const PointCloud& cloud,
                             const Similarity& guess, const Sim3IcpOptions& options) {
  options.check();
  require(std::isfinite(guess.scale) && guess.scale > 0.0 && guess.T_target_source.is_finite(), "guess",
          "a finite similarity of positive scale");
  if (points.size() < fewest_points) {
    throw InputError("points", "at least 20 are needed, there are " + std::to_string(points.size()));
  }
  if (cloud.size() < fewest_cloud_points) {
    throw InputError("cloud", "at least 100 points are needed, there are " + std::to_string(cloud.size()));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InputError("points", "point " + std::to_string(i), "is not finite");
  }
  return Aligner(points, cloud, options).run(guess);
}

}  // namespace odosplat
