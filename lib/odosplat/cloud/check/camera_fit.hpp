// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "odosplat/cloud/check/camera_pairs.hpp"
#include "odosplat/cloud/check/measured.hpp"

namespace odosplat {

struct CameraFitOptions {
  /// What is estimated; the rest is taken as declared.
  bool focal = true;  // of both axes, by one factor
  bool center = true;
  bool distortion = true;
  bool readout = true;
  bool depth_scale = true;
  bool time_offset = true;
  int pairs = 48;
  /// Differences that are not called wrong, whatever their sigmas: those of usual depth cameras, which tracking bears.
  double focal_tolerance = 0.01;    // as a share
  double center_tolerance = 0.015;  // of the image's width
  double radial_tolerance = 0.015;  // of the image's width, at its corners
  double depth_tolerance = 0.03;    // as a share
  double time_tolerance = 0.012;    // [s]
  double sure = 4.0;                // standard deviations by which a value must differ to be called wrong

  void check() const;
};

/// One question and what the images say to it.
struct CameraFinding {
  std::string part;           // "focal length", "principal point", "distortion", "depth scale", "time offset"
  std::optional<bool> right;  // whether it is as declared; none: the images do not determine it well enough
  std::string text;           // one sentence; empty if right
};

/// held: stays as declared because the caller says so; open: because the images do not determine it.
enum class Estimated { yes, held, open };

/// Camera, depth scale and time offset by which images, depth and poses would agree.
struct CameraFit {
  bool measured = false;  // false: nothing but `reason` is set
  std::string reason;     // why not: one sentence
  CameraState state;      // errors of what was declared; 0 for what stays as declared
  CameraState::Vector sigma = CameraState::Vector::Zero();
  std::array<Estimated, CameraState::size> estimated{};
  double pose_error_m = 0.0;  // standard deviation along an axis of what the given relative pose of a pair is off
  double pose_error_deg = 0.0;
  double error_before_px = 0.0;  // median distance along one direction between expected and found patches, as declared
  double error_poses_px = 0.0;   // with camera, time and depth scale corrected
  double error_after_px = 0.0;   // with the pairs' relative poses corrected, too
  int pairs = 0;
  int distances = 0;                    // measured: one or two per patch that was found
  std::vector<CameraFinding> findings;  // of all parts that are not held

  /// In pixels of the camera that is given, as declared.
  Measured focal_px(const Camera& camera) const;
  Measured center_u_px(const Camera& camera) const;
  Measured center_v_px(const Camera& camera) const;
  Measured corner_shift_px(const Camera& camera) const;  // by the distortion, at the image's corners
  Measured readout_s(const Camera& camera) const;
  Measured depth_factor() const;  // by which depth is to be multiplied
};

/// Fits focal length, principal point, radial distortion, readout time, the unit of depth and the time offset between
/// images and poses, together with a correction of each pair's relative pose: Gauss-Newton steps (solve_camera) on the
/// distances between expected and found patches (camera_equations), from pairs with little motion to such with much.
/// Sigmas: as in fit_cloud, with weak priors. A value whose sigma comes near its prior's is not determined: the fit is
/// repeated with the worst of these as declared. Not measured: too few pairs with enough patches, steps that do not
/// become small, relative poses of the pairs off by more than can be told. Findings: wrong if a value differs by more
/// than its tolerance and by `sure` sigmas; none if `sure` sigmas are more than three tolerances. declared: the camera in
/// whose pixels they are given, where input.camera may be that of smaller images. Deterministic. Throws InputError on bad
/// options.
CameraFit fit_camera(const CameraFitInput& input, const Camera& declared, const CameraFitOptions& options = {});

}  // namespace odosplat
