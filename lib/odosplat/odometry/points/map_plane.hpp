// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <optional>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"
#include "odosplat/core/se3.hpp"

namespace odosplat {

/// A plane N . p = D; the scale of (N, D) is free.
struct Plane {
  Eigen::Vector3d N = Eigen::Vector3d::Zero();
  double D = 0.0;
};

struct MapPlaneOptions {
  int radius = 2;                    // [px] half side of the window that a plane is fitted to
  double same_surface = 0.04;        // relative difference of inverse depth within one surface
  double min_support = 0.35;         // share of the window that must lie on the surface
  double max_relative_sigma = 0.05;  // sigma / depth above which a pixel has no usable depth
  double relative_floor = 0.003;     // share of depth that sigma is raised to if it is smaller
  double min_cosine = 0.15;          // between normal and ray; flatter planes are taken as facing the camera

  void check() const;
};

/// The surface that a rendered depth image shows at a pixel.
struct SurfacePoint {
  Eigen::Vector3d m_camera;  // [1/m] plane m . p = 1 in the camera's frame: inverse depth of any pixel = m . ray(u, v)
  double inverse_depth;      // [1/m] at the pixel
  double sigma;              // [1/m] standard deviation of inverse_depth
  bool edge;                 // the window shows more than one surface; this is the nearest of them
};

/// Fits inverse depth as a linear function of the pixel (exact for planes) over the window around (x, y), which is
/// sampled every `stride` pixels. At depth edges the nearest surface is taken: an image edge moves with the surface in
/// front. sigma may be empty. Returns nothing where the map has no depth, too large a sigma or too small a surface.
/// Pure function.
std::optional<SurfacePoint> fit_surface(const Camera& camera, const DepthImage& depth, const cv::Mat1f& sigma, int x,
                                        int y, int stride, const MapPlaneOptions& options);

/// The plane m . p_camera = 1 in world coordinates.
Plane world_plane(const Eigen::Vector3d& m_camera, const SE3& T_world_camera);
/// And back, for a camera anywhere: m with m . p_camera = 1 on the plane. Not finite if the camera lies in the plane.
Eigen::Vector3d plane_in_camera(const Plane& plane_world, const SE3& T_world_camera);

}  // namespace odosplat
