// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/core/cloud_batch.hpp"

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {

Eigen::Vector3f round_point(const std::string& name, const Eigen::Vector3d& point) {
  constexpr double max_error = 1e-3;  // [m]
  Eigen::Vector3f rounded = point.cast<float>();
  const double error = (rounded.cast<double>() - point).cwiseAbs().maxCoeff();
  if (error <= max_error) return rounded;
  throw InputError(
      name, formatted("is too far from the origin: a point at %.6g %.6g %.6g would move by %.3g m in single precision; "
                      "shift it with `odosplat cloud --from FILE --origin X Y Z`",
                      point.x(), point.y(), point.z(), error));
}

}  // namespace odosplat
