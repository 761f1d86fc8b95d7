// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/near_origin.hpp"

#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

constexpr double harmful_m = 1e-3;
constexpr double harmful_share = 1e-5;

double at_share(std::vector<double>& values, double share) {
  const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[static_cast<std::size_t>(place)];
}

// Distance from |value| to the next larger number in single precision.
double float_step(double value) {
  const auto size = static_cast<float>(std::abs(value));
  return static_cast<double>(std::nextafter(size, INFINITY)) - static_cast<double>(size);
}

}  // namespace

void require_near_origin(const std::string& name, const std::vector<Eigen::Vector3d>& positions) {
  if (positions.empty()) return;
  Eigen::Vector3d median;
  double spread = 0.0;
  double step = 0.0;
  std::vector<double> values(positions.size());
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!std::isfinite(positions[i][axis])) throw InputError(name, "a position is not finite");
      values[i] = positions[i][axis];
    }
    median[axis] = at_share(values, 0.5);
    spread = std::max(spread, at_share(values, 0.75) - at_share(values, 0.25));
    step = std::max(step, float_step(median[axis]));
  }
  if (0.5 * step <= harmful_m || 0.5 * step <= harmful_share * spread) return;
  // Rounded to whole kilometres: short to type, and the remaining median coordinates are below 1 km.
  const Eigen::Vector3d origin = (median / 1000.0).array().round() * 1000.0;
  throw InputError(
      name,
      formatted("is too far from the origin: around %.7g %.7g %.7g single precision goes by steps of %.2g m; take "
                "an origin such as %.9g %.9g %.9g off the poses, and the same off the cloud (`odosplat cloud "
                "--from FILE --origin X Y Z`)",
                median.x(), median.y(), median.z(), step, origin.x(), origin.y(), origin.z()));
}

void require_near_origin(const std::string& name, const Trajectory& poses) {
  std::vector<Eigen::Vector3d> positions;
  positions.reserve(poses.size());
  for (const StampedPose& pose : poses) positions.push_back(pose.T_world_camera.translation());
  require_near_origin(name, positions);
}

}  // namespace odosplat
