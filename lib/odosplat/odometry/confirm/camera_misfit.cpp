// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/odometry/confirm/camera_misfit.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>

#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr int least_patches = 20;  // squares that agree somewhat, below which an image is not used
constexpr double settled = 1e-4;   // [m, rad, and of the focal length] a step that moves nothing by a visible part of a
                                   // pixel

struct Reduced {
  Eigen::Matrix4d information;
  Eigen::Vector4d vector;
  Eigen::Matrix<double, 6, 4> pose_by_camera;  // change of the best pose with the camera's correction
  Matrix6d pose_covariance;                    // of the pose, the camera known
};

Reduced eliminate_pose(const MisfitSystem& system) {
  Matrix6d pose = system.information.topLeftCorner<6, 6>();
  pose.diagonal().array() += 1e-9 * pose.trace();
  Reduced reduced;
  reduced.pose_covariance = pose.inverse();
  const Eigen::Matrix<double, 6, 4> mixed = system.information.topRightCorner<6, 4>();
  reduced.pose_by_camera = -reduced.pose_covariance * mixed;
  reduced.information = system.information.bottomRightCorner<4, 4>() + mixed.transpose() * reduced.pose_by_camera;
  reduced.vector = system.vector.tail<4>() + reduced.pose_by_camera.transpose() * system.vector.head<6>();
  return reduced;
}

}  // namespace

void CameraMisfitOptions::check() const {
  require(focal_prior > 0.0 && center_prior > 0.0 && radial_prior > 0.0, "misfit.priors", "positive");
  require(iterations >= 1, "misfit.iterations", "at least 1");
  require(min_patch >= 0.0 && min_patch < 1.0, "misfit.min_patch", "in [0, 1)");
  require(covariance_factor > 0.0, "misfit.covariance_factor", "positive");
}

CameraMisfit::CameraMisfit(const CameraMisfitOptions& options) : options_(options) {
  options_.check();
  const Eigen::Vector4d prior(options.focal_prior, options.center_prior, options.center_prior, options.radial_prior);
  information_ = prior.cwiseProduct(prior).cwiseInverse().asDiagonal();
}

MisfitEffect CameraMisfit::add(const ViewPatches& patches, const FramePyramid& image, const SE3& T_world_camera) {
  // Starts from the errors that earlier keyframes gave; the pose is estimated along with them.
  Eigen::Vector4d camera = correction().vector();
  SE3 T_camera_world = T_world_camera.inverse();
  MisfitSystem system;
  const auto look = [&](int coarse) {
    system = patches.misfit(image, T_camera_world, CameraCorrection::from(camera), coarse, options_.min_patch);
    return system.patches >= least_patches;
  };
  for (int coarse = 1; coarse >= 0; --coarse) {
    for (int k = 0; k < options_.iterations; ++k) {
      if (!look(coarse)) return {};
      Eigen::Matrix<double, 10, 10> information = system.information;
      Eigen::Matrix<double, 10, 1> vector = system.vector;
      const double scale = system.noise * options_.covariance_factor;
      information.topLeftCorner<6, 6>().diagonal().array() += 1e-9 * information.topLeftCorner<6, 6>().trace();
      information.bottomRightCorner<4, 4>() += scale * information_;
      vector.tail<4>() += scale * (vector_ - information_ * camera);
      const Eigen::Matrix<double, 10, 1> step = information.ldlt().solve(vector);
      if (!step.allFinite()) return {};
      camera += step.tail<4>();
      T_camera_world = SE3::exp(step.head<6>()) * T_camera_world;
      if (step.norm() < settled) break;
    }
  }
  if (!look(0)) return {};
  const double scale = 1.0 / (system.noise * options_.covariance_factor);
  const Reduced reduced = eliminate_pose(system);
  information_ += scale * reduced.information;
  vector_ += scale * (reduced.vector + reduced.information * camera);
  const Eigen::Vector4d found = correction().vector();
  MisfitEffect effect;
  // The calibration counts as right until an error is significant. Images of a flat wall, for example, determine none.
  if (likely_cause(image.cameras.front()).empty()) return effect;
  const Vector6d twist = reduced.pose_by_camera * found;
  effect.meters = twist.head<3>().norm();
  effect.radians = twist.tail<3>().norm();
  const Matrix6d in_camera =
      twist * twist.transpose() + reduced.pose_by_camera * covariance() * reduced.pose_by_camera.transpose();
  const Matrix6d adjoint = T_world_camera.adjoint();
  effect.covariance = adjoint * in_camera * adjoint.transpose();
  return effect;
}

CameraCorrection CameraMisfit::correction() const { return CameraCorrection::from(information_.ldlt().solve(vector_)); }

Eigen::Matrix4d CameraMisfit::covariance() const { return information_.inverse(); }

std::string CameraMisfit::likely_cause(const Camera& camera) const {
  const Eigen::Vector4d found = correction().vector();
  const Eigen::Vector4d sigma = covariance().diagonal().cwiseSqrt();
  // The errors in pixels at half the image's width.
  const double half = 0.5 * camera.width;
  const double radius = half / camera.fx;
  const Eigen::Vector4d pixels(found[0] * half, found[1] * camera.fx, found[2] * camera.fy,
                               found[3] * radius * radius * half);
  int worst = 0;
  for (int k = 1; k < 4; ++k) {
    if (std::abs(pixels[k]) > std::abs(pixels[worst])) worst = k;
  }
  constexpr double least_pixels = 1.5;
  constexpr double least_sigmas = 5.0;
  if (std::abs(pixels[worst]) < least_pixels || std::abs(found[worst]) < least_sigmas * sigma[worst]) return "";
  char text[160];
  if (worst == 0) {
    std::snprintf(text, sizeof(text), "the images look as if the focal length were %.1f %% %s",
                  100.0 * std::abs(found[0]), found[0] > 0.0 ? "longer" : "shorter");
  } else if (worst == 3) {
    std::snprintf(text, sizeof(text), "the images look distorted: %.1f px at half their width", pixels[3]);
  } else {
    std::snprintf(text, sizeof(text), "the images look as if the principal point were %.1f px further %s",
                  std::abs(pixels[worst]),
                  worst == 1 ? (pixels[1] > 0.0 ? "right" : "left") : (pixels[2] > 0.0 ? "down" : "up"));
  }
  return text;
}

}  // namespace odosplat
