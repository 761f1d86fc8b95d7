// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/camera/combine_lens.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "odosplat/camera/lens_model.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"

namespace odosplat {
namespace {

constexpr int grid_columns = 24;
constexpr int grid_rows = 18;
constexpr int most_parameters = 9;  // fx fy cx cy k1 k2 p1 p2 k3
constexpr double most_rms_px = 0.2;

/// A ray at depth 1 and the pixel of the image as taken in which it is to be seen.
struct SeenRay {
  Eigen::Vector2d ray;
  Eigen::Vector2d pixel;
};

Eigen::Vector2d pixel_of(const Lens& lens, const Eigen::Vector2d& ray) {
  const Eigen::Vector2d p = LensModel(lens.distortion).distorted(ray);
  return {lens.camera.fx * p.x() + lens.camera.cx, lens.camera.fy * p.y() + lens.camera.cy};
}

/// Pixels of the grid that the image as taken shows, and shows once.
std::vector<SeenRay> rays_of_grid(const Lens& as_declared, const Camera& undistorted,
                                  const CameraCorrection& correction) {
  const LensModel model(as_declared.distortion);
  std::vector<SeenRay> rays;
  for (int row = 0; row < grid_rows; ++row) {
    for (int column = 0; column < grid_columns; ++column) {
      const double u = (undistorted.width - 1.0) * column / (grid_columns - 1.0);
      const double v = (undistorted.height - 1.0) * row / (grid_rows - 1.0);
      const Eigen::Vector3d ray = correction.ray(undistorted, u, v);
      // Not (u, v) itself, because ray() is the inverse of project() up to a small error only.
      const Eigen::Vector2d seen = correction.project(undistorted, ray);
      const Eigen::Vector2d declared_ray = undistorted.ray(seen.x(), seen.y()).head<2>();
      if (!(model.slope(declared_ray).determinant() > 0.0)) continue;
      const Eigen::Vector2d pixel = pixel_of(as_declared, declared_ray);
      const bool inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= as_declared.camera.width - 1.0 &&
                          pixel.y() <= as_declared.camera.height - 1.0;
      if (inside) rays.push_back({ray.head<2>(), pixel});
    }
  }
  return rays;
}

/// Derivatives of pixel_of() by the parameters.
Eigen::Matrix<double, 2, most_parameters> slopes_of(const Lens& lens, const Eigen::Vector2d& ray) {
  const double x = ray.x();
  const double y = ray.y();
  const double r2 = ray.squaredNorm();
  const double fx = lens.camera.fx;
  const double fy = lens.camera.fy;
  const Eigen::Vector2d p = LensModel(lens.distortion).distorted(ray);
  Eigen::Matrix<double, 2, most_parameters> slopes;
  slopes << p.x(), 0.0, 1.0, 0.0, fx * x * r2, fx * x * r2 * r2, fx * 2.0 * x * y, fx * (r2 + 2.0 * x * x),
      fx * x * r2 * r2 * r2,  //
      0.0, p.y(), 0.0, 1.0, fy * y * r2, fy * y * r2 * r2, fy * (r2 + 2.0 * y * y), fy * 2.0 * x * y,
      fy * y * r2 * r2 * r2;
  return slopes;
}

/// Vectors from where the lens shows the rays to where they are to be seen, one below the other.
Eigen::VectorXd missing_px(const Lens& lens, const std::vector<SeenRay>& rays) {
  Eigen::VectorXd missing(2 * static_cast<Eigen::Index>(rays.size()));
  Eigen::Index row = 0;
  for (const SeenRay& seen : rays) {
    missing.segment<2>(row) = seen.pixel - pixel_of(lens, seen.ray);
    row += 2;
  }
  return missing;
}

/// Gauss-Newton from `lens`. The problem is linear but for the focal lengths' products with the coefficients, so that
/// few steps suffice.
void fit_to(const std::vector<SeenRay>& rays, Lens& lens) {
  constexpr int most_steps = 10;
  constexpr double small_step_px = 1e-9;
  const auto parameters = static_cast<Eigen::Index>(4 + lens.distortion.size());
  Eigen::MatrixXd J(2 * static_cast<Eigen::Index>(rays.size()), parameters);
  for (int k = 0; k < most_steps; ++k) {
    Eigen::Index row = 0;
    for (const SeenRay& seen : rays) {
      J.middleRows<2>(row) = slopes_of(lens, seen.ray).leftCols(parameters);
      row += 2;
    }
    const Eigen::VectorXd step = J.colPivHouseholderQr().solve(missing_px(lens, rays));
    lens.camera.fx += step[0];
    lens.camera.fy += step[1];
    lens.camera.cx += step[2];
    lens.camera.cy += step[3];
    Eigen::Index place = 4;
    for (double& coefficient : lens.distortion) coefficient += step[place++];
    if (!((J * step).cwiseAbs().maxCoeff() > small_step_px)) break;
  }
}

}  // namespace

Lens combined_lens(const Lens& as_declared, const Camera& undistorted, const CameraCorrection& correction) {
  Lens lens = as_declared;
  lens.camera.fx *= 1.0 + correction.focal;
  lens.camera.fy *= 1.0 + correction.focal;
  lens.camera.cx += as_declared.camera.fx * correction.center_u;
  lens.camera.cy += as_declared.camera.fy * correction.center_v;
  const std::vector<double>& declared = as_declared.distortion;
  if (std::all_of(declared.begin(), declared.end(), [](double d) { return d == 0.0; })) {
    lens.distortion.clear();
    if (correction.radial != 0.0) lens.distortion = {correction.radial, 0.0, 0.0, 0.0};
    return lens;
  }
  const std::vector<SeenRay> rays = rays_of_grid(as_declared, undistorted, correction);
  if (rays.size() < static_cast<std::size_t>(most_parameters)) {
    throw InputError("distortion", "the image shows too little of the undistorted one to correct it");
  }
  fit_to(rays, lens);
  const double rms = std::sqrt(missing_px(lens, rays).squaredNorm() / static_cast<double>(rays.size()));
  if (!(rms <= most_rms_px)) {
    throw InputError("distortion",
                     formatted("no lens of this model is as the images say: the nearest is off by %.2f px "
                               "(at most %.2f)",
                               rms, most_rms_px));
  }
  return lens;
}

}  // namespace odosplat
