// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/points/epipolar_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int max_steps = 150;
constexpr float margin =
    1.0F;  // [px] of the pattern to the image's edge, so that bilinear samples and steps stay inside

float interpolate_at(const GrayImage& image, float u, float v) {
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const float a = u - static_cast<float>(x);
  const float b = v - static_cast<float>(y);
  const float* r0 = image[y] + x;
  const float* r1 = image[y + 1] + x;
  const float top = r0[0] + a * (r0[1] - r0[0]);
  const float bottom = r1[0] + a * (r1[1] - r1[0]);
  return top + b * (bottom - top);
}

/// The pattern as it lies around a place in the target.
class TargetPattern {
 public:
  TargetPattern(const ImmaturePoint& point, const Eigen::Matrix2f& turn, const Brightness& brightness,
                const GrayImage& target, float huber)
      : point_(point), target_(target), huber_(huber) {
    const auto gain = static_cast<float>(std::exp(brightness.a));
    for (std::size_t k = 0; k < pattern_size; ++k) {
      const Eigen::Vector2f o(static_cast<float>(pattern[k][0]), static_cast<float>(pattern[k][1]));
      offsets_[k] = turn * o;
      reach_ = std::max({reach_, std::abs(offsets_[k].x()), std::abs(offsets_[k].y())});
      expected_[k] = gain * point.intensity[k] + static_cast<float>(brightness.b);
    }
  }

  bool inside(const Eigen::Vector2f& at) const {
    const float border = reach_ + margin + 1.0F;
    return at.x() >= border && at.y() >= border && at.x() < static_cast<float>(target_.cols) - 1.0F - border &&
           at.y() < static_cast<float>(target_.rows) - 1.0F - border;
  }

  float cost(const Eigen::Vector2f& at) const {
    float sum = 0.0F;
    for (std::size_t k = 0; k < pattern_size; ++k) {
      const Eigen::Vector2f p = at + offsets_[k];
      const float size = std::abs(interpolate_at(target_, p.x(), p.y()) - expected_[k]);
      sum += point_.weight[k] * (size <= huber_ ? 0.5F * size * size : huber_ * (size - 0.5F * huber_));
    }
    return sum;
  }

  /// Gauss-Newton step [px] along the direction.
  float step(const Eigen::Vector2f& at, const Eigen::Vector2f& direction) const {
    float H = 1e-12F;
    float g = 0.0F;
    for (std::size_t k = 0; k < pattern_size; ++k) {
      const Eigen::Vector2f p = at + offsets_[k];
      const Eigen::Vector2f ahead = p + 0.5F * direction;
      const Eigen::Vector2f behind = p - 0.5F * direction;
      const float slope =
          interpolate_at(target_, ahead.x(), ahead.y()) - interpolate_at(target_, behind.x(), behind.y());
      const float r = interpolate_at(target_, p.x(), p.y()) - expected_[k];
      const float w = point_.weight[k] * (huber_ / std::max(huber_, std::abs(r)));
      H += w * slope * slope;
      g += w * slope * r;
    }
    return -g / H;
  }

  float outlier_cost(float outlier) const {
    float sum = 0.0F;
    for (const float w : point_.weight) sum += w * huber_ * (outlier - 0.5F * huber_);
    return sum;
  }

 private:
  const ImmaturePoint& point_;
  const GrayImage& target_;
  float huber_;
  std::array<Eigen::Vector2f, pattern_size> offsets_;
  std::array<float, pattern_size> expected_{};
  float reach_ = 0.0F;
};

/// The part of a -> b, as shares of it, that lies at least `border` inside the image; empty if first > second.
std::pair<double, double> clip(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double border,
                               const cv::Size& size) {
  double from = 0.0;
  double to = 1.0;
  const std::array<double, 2> last{size.width - 1 - border, size.height - 1 - border};
  for (int axis = 0; axis < 2; ++axis) {
    const double d = b[axis] - a[axis];
    if (std::abs(d) < 1e-9) {
      if (a[axis] < border || a[axis] > last[static_cast<std::size_t>(axis)]) return {1.0, 0.0};
      continue;
    }
    double first = (border - a[axis]) / d;
    double second = (last[static_cast<std::size_t>(axis)] - a[axis]) / d;
    if (first > second) std::swap(first, second);
    from = std::max(from, first);
    to = std::min(to, second);
  }
  return {from, to};
}

}  // namespace

void EpipolarSearchOptions::check() const {
  require(max_length > 0.0, "epipolar.max_length", "positive");
  require(min_length > 0.0, "epipolar.min_length", "positive");
  require(huber > 0.0 && outlier >= huber, "epipolar.huber", "positive, at most outlier");
  require(location_error > 0.0 && max_error > location_error, "epipolar.location_error", "positive, below max_error");
  require(min_scale > 0.0 && min_scale < 1.0 && max_scale > 1.0, "epipolar.min_scale", "below 1, max_scale above");
  require(distinct_radius >= 1, "epipolar.distinct_radius", "at least 1 px");
}

SearchResult search_epipolar_line(const ImmaturePoint& point, const SE3& T_target_host, const Camera& camera,
                                  const GrayImage& target, const Brightness& brightness,
                                  const EpipolarSearchOptions& options) {
  SearchResult result{SearchStatus::out_of_view, point.min_q, point.max_q, 0.0, 0.0};
  // The point at inverse depth q is (a + t q) / q: the image of a + t q.
  const Eigen::Vector3d a = T_target_host.rotation() * camera.ray(point.u, point.v);
  const Eigen::Vector3d& t = T_target_host.translation();
  // The pattern can be recognised only within a range of scales, 1 / (a + t q).z, which limits the inverse depth; these
  // limits also keep the point in front of the camera.
  double q_far = point.min_q;
  double q_near = point.max_q;
  if (!(a.z() > 0.0)) return result;
  if (t.z() > 1e-9) q_near = std::min(q_near, (1.0 / options.min_scale - a.z()) / t.z());
  if (t.z() < -1e-9) q_near = std::min(q_near, (1.0 / options.max_scale - a.z()) / t.z());
  if (!(q_near > q_far)) return result;
  const Eigen::Vector2d far_end = camera.project(a + t * q_far);
  const Eigen::Vector2d near_end = camera.project(a + t * q_near);

  const Eigen::Matrix3d R = T_target_host.rotation_matrix();
  Eigen::Matrix2f turn;
  turn << static_cast<float>(R(0, 0)), static_cast<float>(R(0, 1) * camera.fx / camera.fy),
      static_cast<float>(R(1, 0) * camera.fy / camera.fx), static_cast<float>(R(1, 1));
  const TargetPattern pattern_at(point, turn, brightness, target, static_cast<float>(options.huber));

  const Eigen::Vector2d line = near_end - far_end;
  const double whole = line.norm();
  result.length = whole;
  constexpr double border = 6.0;
  auto [from, to] = clip(far_end, near_end, border, target.size());
  if (from > to) return result;
  if (whole < options.min_length) {
    result.status = SearchStatus::certain;
    return result;
  }
  const double longest = options.max_length * (camera.width + camera.height);
  to = std::min(to, from + longest / whole);
  const Eigen::Vector2d direction = line / whole;
  const Eigen::Vector2f along = direction.cast<float>();
  // The line's direction in the host's image.
  const Eigen::Vector2f in_host = (turn.transpose() * along).normalized();
  const Eigen::Vector2f across(-in_host.y(), in_host.x());
  const float with_gradient = in_host.dot(point.tensor * in_host);
  const float against = across.dot(point.tensor * across);
  const double error = options.location_error + options.location_error * static_cast<double>(with_gradient + against) /
                                                    std::max(1e-12, static_cast<double>(with_gradient));
  if (2.0 * error > whole || error > options.max_error) {
    result.status = SearchStatus::uncertain;
    return result;
  }

  const double length = (to - from) * whole;
  const int steps = std::clamp(static_cast<int>(std::ceil(length)) + 1, 2, max_steps);
  const double stride = length / (steps - 1);
  const Eigen::Vector2d start = far_end + from * line;
  std::array<float, max_steps> costs{};
  int best = -1;
  for (int i = 0; i < steps; ++i) {
    const Eigen::Vector2f at = (start + i * stride * direction).cast<float>();
    costs[static_cast<std::size_t>(i)] =
        pattern_at.inside(at) ? pattern_at.cost(at) : std::numeric_limits<float>::infinity();
    if (best < 0 || costs[static_cast<std::size_t>(i)] < costs[static_cast<std::size_t>(best)]) best = i;
  }
  if (!std::isfinite(costs[static_cast<std::size_t>(best)])) return result;
  float second = std::numeric_limits<float>::infinity();
  for (int i = 0; i < steps; ++i) {
    if (std::abs(i - best) * stride >= options.distinct_radius) {
      second = std::min(second, costs[static_cast<std::size_t>(i)]);
    }
  }
  Eigen::Vector2f at = (start + best * stride * direction).cast<float>();
  float cost = costs[static_cast<std::size_t>(best)];
  double moved = 0.0;
  for (int iteration = 0; iteration < 4; ++iteration) {
    const float step = std::clamp(pattern_at.step(at, along), -0.5F, 0.5F);
    const Eigen::Vector2f next = at + step * along;
    if (!std::isfinite(step) || !pattern_at.inside(next)) break;
    const float next_cost = pattern_at.cost(next);
    if (next_cost > cost) break;
    at = next;
    cost = next_cost;
    moved += step;
    if (std::abs(step) < 0.02F) break;
  }
  if (!(cost < pattern_at.outlier_cost(static_cast<float>(options.outlier)))) {
    result.status = SearchStatus::outlier;
    return result;
  }
  result.quality = second / std::max(cost, 1e-9F);

  // Back from the place on the line to inverse depth, by the axis along which the line runs.
  const double place = from * whole + best * stride + moved;
  const auto q_at = [&](double s) {
    const Eigen::Vector2d p = far_end + s * direction;
    const bool by_u = std::abs(direction.x()) > std::abs(direction.y());
    const double x = by_u ? (p.x() - camera.cx) / camera.fx : (p.y() - camera.cy) / camera.fy;
    const double numerator = a.z() * x - (by_u ? a.x() : a.y());
    const double denominator = (by_u ? t.x() : t.y()) - t.z() * x;
    return numerator / denominator;
  };
  const double q0 = q_at(place - error);
  const double q1 = q_at(place + error);
  const double q = q_at(place);
  if (!std::isfinite(q0) || !std::isfinite(q1) || !(q > 0.0)) {
    result.status = SearchStatus::outlier;
    return result;
  }
  result.min_q = std::max(1e-4, std::min(q0, q1));
  result.max_q = std::max(q0, q1);
  result.length = 2.0 * error;
  result.status = result.max_q > result.min_q ? SearchStatus::good : SearchStatus::outlier;
  return result;
}

}  // namespace odosplat
