// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/camera_misfit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

constexpr int least_patches = 20;  // squares that agree somewhat, below which an image is not used
constexpr double settled = 1e-4;   // [m, rad, and of the focal length] a step that moves nothing by a visible part of a
                                   // pixel

constexpr int unknowns = CameraCorrection::size;

struct Reduced {
  CameraCorrection::Matrix information;
  CameraCorrection::Vector vector;
  Eigen::Matrix<double, 6, unknowns> pose_by_camera;  // change of the best pose with the camera's correction
  Matrix6d pose_covariance;                           // of the pose, the camera known
};

Reduced eliminate_pose(const MisfitSystem& system) {
  Matrix6d pose = system.information.topLeftCorner<6, 6>();
  pose.diagonal().array() += 1e-9 * pose.trace();
  Reduced reduced;
  reduced.pose_covariance = pose.inverse();
  const Eigen::Matrix<double, 6, unknowns> mixed = system.information.topRightCorner<6, unknowns>();
  reduced.pose_by_camera = -reduced.pose_covariance * mixed;
  reduced.information =
      system.information.bottomRightCorner<unknowns, unknowns>() + mixed.transpose() * reduced.pose_by_camera;
  reduced.vector = system.vector.tail<unknowns>() + reduced.pose_by_camera.transpose() * system.vector.head<6>();
  return reduced;
}

}  // namespace

void CameraMisfitOptions::check() const {
  require(focal_prior > 0.0 && center_prior > 0.0 && radial_prior > 0.0 && readout_prior > 0.0, "misfit.priors",
          "positive");
  require(iterations >= 1, "misfit.iterations", "at least 1");
  require(min_patch >= 0.0 && min_patch < 1.0, "misfit.min_patch", "in [0, 1)");
  require(covariance_factor > 0.0, "misfit.covariance_factor", "positive");
}

CameraMisfit::CameraMisfit(const CameraMisfitOptions& options) : options_(options) {
  options_.check();
  const CameraCorrection::Vector prior{options.focal_prior, options.center_prior, options.center_prior,
                                       options.radial_prior, options.readout_prior};
  information_ = prior.cwiseProduct(prior).cwiseInverse().asDiagonal();
}

PoseByCamera CameraMisfit::add(const ViewPatches& patches, const FramePyramid& image, const SE3& T_world_camera,
                               const Vector6d& velocity) {
  // Starts from the errors that earlier keyframes gave; the pose is estimated along with them.
  CameraCorrection::Vector camera = correction().vector();
  PoseByCamera pose;
  pose.T_world_camera = T_world_camera;
  SE3 T_camera_world = T_world_camera.inverse();
  MisfitSystem system;
  const auto look = [&](int coarse) {
    system =
        patches.misfit(image, T_camera_world, velocity, CameraCorrection::from(camera), coarse, options_.min_patch);
    return system.patches >= least_patches;
  };
  for (int coarse = 1; coarse >= 0; --coarse) {
    for (int k = 0; k < options_.iterations; ++k) {
      if (!look(coarse)) return pose;
      MisfitSystem::Matrix information = system.information;
      MisfitSystem::Vector vector = system.vector;
      const double scale = system.noise * options_.covariance_factor;
      information.topLeftCorner<6, 6>().diagonal().array() += 1e-9 * information.topLeftCorner<6, 6>().trace();
      information.bottomRightCorner<unknowns, unknowns>() += scale * information_;
      vector.tail<unknowns>() += scale * (vector_ - information_ * camera);
      const MisfitSystem::Vector step = information.ldlt().solve(vector);
      if (!step.allFinite()) return pose;
      camera += step.tail<unknowns>();
      T_camera_world = SE3::exp(step.head<6>()) * T_camera_world;
      if (step.norm() < settled) break;
    }
  }
  if (!look(0)) return pose;
  const double scale = 1.0 / (system.noise * options_.covariance_factor);
  const Reduced reduced = eliminate_pose(system);
  information_ += scale * reduced.information;
  vector_ += scale * (reduced.vector + reduced.information * camera);
  flow_ = std::max(flow_, system.flow);
  pose.change = reduced.pose_by_camera;
  pose.determined = true;
  return pose;
}

MisfitEffect CameraMisfit::effect(const PoseByCamera& pose, const Camera& camera) const {
  MisfitEffect effect;
  effect.sigmas = largest(camera).sigmas;
  const Vector6d twist = pose.change * correction().vector();
  effect.meters = twist.head<3>().norm();
  effect.radians = twist.tail<3>().norm();
  if (!effect.significant()) return effect;
  const Matrix6d in_camera = twist * twist.transpose() + pose.change * covariance() * pose.change.transpose();
  const Matrix6d adjoint = pose.T_world_camera.adjoint();
  effect.covariance = adjoint * in_camera * adjoint.transpose();
  return effect;
}

CameraCorrection CameraMisfit::correction() const { return CameraCorrection::from(information_.ldlt().solve(vector_)); }

CameraCorrection::Matrix CameraMisfit::covariance() const { return information_.inverse(); }

CameraMisfit::Largest CameraMisfit::largest(const Camera& camera) const {
  constexpr double least_pixels = 1.5;
  const CameraCorrection::Vector found = correction().vector();
  const CameraCorrection::Vector sigma = covariance().diagonal().cwiseSqrt();
  const double half = 0.5 * camera.width;
  const double radius = half / camera.fx;
  const CameraCorrection::Vector pixels{found[0] * half, found[1] * camera.fx, found[2] * camera.fy,
                                        found[3] * radius * radius * half, 0.5 * found[4] * flow_};
  // Of the errors that matter, the largest significant one; else the most certain.
  Largest found_error{0, 0.0, 0.0};
  for (int k = 0; k < unknowns; ++k) {
    if (std::abs(pixels[k]) < least_pixels) continue;
    const double sigmas = std::abs(found[k]) / sigma[k];
    const bool significant = sigmas >= MisfitEffect::significant_sigmas;
    const bool was_significant = found_error.sigmas >= MisfitEffect::significant_sigmas;
    const bool larger = significant && was_significant ? std::abs(pixels[k]) > std::abs(found_error.pixels)
                                                       : sigmas > found_error.sigmas;
    if (larger) found_error = {k, pixels[k], sigmas};
  }
  return found_error;
}

std::string CameraMisfit::likely_cause(const Camera& camera) const {
  const Largest error = largest(camera);
  if (error.sigmas < MisfitEffect::significant_sigmas) return "";
  const CameraCorrection found = correction();
  const double pixels = std::abs(error.pixels);
  const bool positive = error.pixels > 0.0;
  const auto shifted = [pixels](const char* where) {
    return formatted("the images look as if the principal point were %.1f px further %s than in the camera file",
                     pixels, where);
  };
  switch (error.number) {
    case 0:
      return formatted("the images look as if the focal length were %.1f %% %s than in the camera file",
                       100.0 * std::abs(found.focal), positive ? "longer" : "shorter");
    case 1:
      return shifted(positive ? "right" : "left");
    case 2:
      return shifted(positive ? "down" : "up");
    case 3:
      return formatted("the images look distorted otherwise than the camera file says: by %.1f px at half their width",
                       error.pixels);
    default:
      const double readout = camera.readout + found.readout;
      return formatted("the images look as if their rows were taken one after the other, within %.0f ms%s",
                       1000.0 * std::abs(readout), readout >= 0.0 ? " (rolling shutter)" : ", the last one first") +
             (camera.readout == 0.0 ? "" : formatted("; the camera file says %.0f ms", 1000.0 * camera.readout));
  }
}

}  // namespace odosplat
