// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <span>
#include <vector>

#include "odosplat/map/map_view.hpp"
#include "odosplat/odometry/frame/frame.hpp"
#include "odosplat/odometry/points/map_plane.hpp"
#include "odosplat/odometry/points/pixel_selector.hpp"
#include "odosplat/odometry/residual_noise.hpp"

namespace odosplat {

/// One pixel of a host image with its place in space and all that alignment needs of it; one cache line.
struct alignas(64) ReferencePoint {
  float x, y, z;    // [m] in the host's frame
  float intensity;  // [grey]
  float weight;     // 0..1, smaller where the gradient is strong (DSO's gradient-dependent weight)
  float u, v;       // [px] of its level
  /// d I_host(pi(exp(xi) p)) / d xi at xi = 0 (six values: translation [grey/m], rotation [grey/rad]), then -I_host
  /// and -1: derivatives of the residual by log gain and by offset. Read as one vector of eight.
  alignas(32) float jacobian[8];
};

/// What a frame is aligned to: pixels of a host image on every pyramid level. The host is a keyframe or a rendered
/// view of the map. Data only.
struct TrackingReference {
  std::vector<Camera> cameras;                      // one per level
  std::vector<std::vector<ReferencePoint>> levels;  // level 0 is full size
  bool bare = false;                                // most of the image has only weak gradients, and pixels of these
                                                    // were picked
  /// True if no level has points: it cannot be aligned to.
  bool empty() const { return levels.empty() || levels.front().empty(); }
};

struct ReferenceOptions {
  int points = 2000;         // wanted on level 0 of a 320x240 image; grows with the square root of the area
  double level_share = 0.6;  // points wanted on a level, as a share of those on the finer level below it
  int min_points = 250;      // wanted on any level
  double gradient_weight = gradient_weight_constant;  // [grey/px] c of the weight c^2 / (c^2 + |gradient|^2)
  double min_gradient = 5.0 / 255;  // [grey/px] of a pixel whose depth comes from another keyframe's point
  double bare_share = 0.5;          // share of the image's regions with picked pixels below which the image counts
                                    // as bare
  double bare_factor = 5.0;         // factor of the points wanted on a bare image, as each contributes little

  void check() const;
  /// Points wanted on level 0 of this camera.
  int wanted(const Camera& camera) const;
};

/// A point of another image, where it falls in this one.
struct TransferredPoint {
  float u, v;  // [px] on level 0
  float q;     // [1/m] inverse depth here
};

/// d pi(exp(xi) p) / d xi at xi = 0, rows u and v [px], columns translation and rotation.
Eigen::Matrix<double, 2, 6> projection_jacobian(const Camera& camera, const Eigen::Vector3d& p_camera);

/// Makes a reference of the host's image (its pyramid and gradients) and the depth seen from the host's pose, both of
/// level 0's size. Source: template Jacobians as in Baker and Matthews 2004. Pixels without trusted depth are left out;
/// an image without texture or depth gives an empty reference, not an error. weak: what picks the pixels of a bare
/// image instead of selector; null: no image counts as bare.
TrackingReference build_reference(const FramePyramid& pyramid, std::span<const GradientImage> gradients,
                                  const ViewImages& view, PixelSelector& selector, const ReferenceOptions& options,
                                  const MapPlaneOptions& plane_options, PixelSelector* weak = nullptr);

/// Adds pixels whose depth is known from points of other keyframes: on every level those that a point falls on, and
/// their neighbours, as far as they have some gradient and are not in the reference already. Where several points fall
/// on one pixel their inverse depths are averaged. Source: DSO's coarse tracking reference.
void add_projected_points(TrackingReference& reference, std::span<const GradientImage> gradients,
                          std::span<const TransferredPoint> projected, const ReferenceOptions& options);

}  // namespace odosplat
