// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"
#include "odosplat/odometry/frame/frame.hpp"

namespace odosplat {

/// Share of the readout time that points above and below the image are moved by at most.
inline constexpr double beyond_rows = 0.75;

/// Where a moving camera with a rolling shutter sees points: each in the row that is taken just when the point falls
/// on it. row_motion: as of FramePyramid, for any level's camera. The exponential map to second order.
template <typename Scalar>
class RowShift {
 public:
  using Vector = Eigen::Matrix<Scalar, 3, 1>;

  RowShift(const Camera& camera, const Vector6d& row_motion)
      : translation_(row_motion.head<3>().template cast<Scalar>()),
        rotation_(row_motion.tail<3>().template cast<Scalar>()),
        slope_(static_cast<Scalar>(camera.fy / camera.height)),
        middle_(static_cast<Scalar>(camera.time_of_row(camera.cy))) {}

  /// The point in the frame of its own row's camera, from that in the frame of the middle row's. Points that do not lie
  /// in front of the camera are returned as they are.
  Vector at(const Vector& p) const {
    constexpr int steps = 3;  // of a fixed-point iteration: the row moves with the point
    constexpr auto beyond = static_cast<Scalar>(beyond_rows);
    const Vector step = rotation_.cross(p) + translation_;
    const Vector bend = rotation_.cross(step);
    Vector q = p;
    for (int k = 0; k < steps && q.z() > Scalar(0.01); ++k) {
      const Scalar s = std::clamp(slope_ * q.y() / q.z() + middle_, -beyond, beyond);
      q = p + s * (step + Scalar(0.5) * s * bend);
    }
    return q;
  }

 private:
  Vector translation_;
  Vector rotation_;
  Scalar slope_;   // of the share of the readout time by y / z
  Scalar middle_;  // that share on the optical axis
};

/// T_camera_view of the camera at the time of the row on which p_view falls, from that of the middle row.
SE3 at_its_row(const SE3& T_camera_view, const Camera& camera, const Eigen::Vector3d& p_view,
               const Vector6d& row_motion);

/// The image with another motion of its rows; the pixels are shared.
FramePyramid with_row_motion(const FramePyramid& image, const Vector6d& row_motion);

/// The image that would have been taken had all rows been taken together with the middle one, of row_motion 0. depth:
/// as seen from the image's pose, of its size, or empty; pixels without depth are taken to lie as far away as the
/// others do in the mean (of inverse depth), or very far where there are none. What the rolling shutter did not see is
/// taken from the image's edge.
FramePyramid with_rows_together(const FramePyramid& image, const DepthImage& depth);

}  // namespace odosplat
