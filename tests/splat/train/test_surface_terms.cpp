// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/train/surface_terms.hpp"

namespace odosplat {
namespace {

Gaussians random_discs(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Gaussians g;
  g.resize(n);
  for (float& v : g.positions) v = static_cast<float>(random.uniform(-1.0, 1.0));
  for (float& v : g.log_scales) v = static_cast<float>(random.uniform(-4.0, -2.0));
  for (float& v : g.rotations) v = static_cast<float>(random.normal());
  return g;
}

/// The three terms of Gaussian i by their definitions, in double.
double reference_terms(const std::vector<double>& p, const std::vector<double>& s, const std::vector<double>& q,
                       const std::vector<float>& anchors, std::size_t i, const SurfaceTermsOptions& options) {
  const float* a = &anchors[8 * i];
  const Eigen::Vector3d point(a[0], a[1], a[2]);
  const Eigen::Vector3d normal(a[4], a[5], a[6]);
  const Eigen::Vector3d position(p[3 * i], p[3 * i + 1], p[3 * i + 2]);
  const double height = normal.dot(position - point);
  const Eigen::Vector3d axis =
      Eigen::Quaterniond(q[4 * i], q[4 * i + 1], q[4 * i + 2], q[4 * i + 3]).normalized() * Eigen::Vector3d::UnitZ();
  const double cosine = normal.dot(axis);
  return options.place_weight * static_cast<double>(a[3]) * height * height +
         options.normal_weight * (1.0 - cosine * cosine) +
         options.flatten_weight * std::exp(s[3 * i + 2] - 0.5 * (s[3 * i] + s[3 * i + 1]));
}

TEST(SurfaceTerms, GradientsAreFiniteDifferencesAndAreAdded) {
  const auto context = compute::Context::open();
  for (const std::size_t n : {1U, 63U, 65U}) {
    const std::vector<float> anchors = surface_anchors(random_discs(n, 1));
    const Gaussians g = random_discs(n, 2);  // at other positions and with other rotations
    const SurfaceTermsOptions options{0.3, 0.7, 0.2};
    SurfaceTerms terms(context, options);
    DeviceGaussians device, gradients;
    device.upload(context, g);
    Gaussians ones = g;
    for (auto* part : {&ones.positions, &ones.log_scales, &ones.rotations}) part->assign(part->size(), 1.0F);
    gradients.upload(context, ones);
    terms.add(device, {context, anchors}, gradients);
    const Gaussians result = gradients.download();

    std::vector<double> p(g.positions.begin(), g.positions.end());
    std::vector<double> s(g.log_scales.begin(), g.log_scales.end());
    std::vector<double> q(g.rotations.begin(), g.rotations.end());
    const auto check = [&](std::vector<double>& values, const std::vector<float>& slopes, std::size_t stride) {
      for (std::size_t k = 0; k < values.size(); ++k) {
        constexpr double h = 1e-6;
        const double kept = values[k];
        values[k] = kept + h;
        const double plus = reference_terms(p, s, q, anchors, k / stride, options);
        values[k] = kept - h;
        const double minus = reference_terms(p, s, q, anchors, k / stride, options);
        values[k] = kept;
        const double expected = (plus - minus) / (2.0 * h * static_cast<double>(n));
        EXPECT_NEAR(slopes[k], 1.0 + expected, 1e-5 * (1.0 + std::abs(expected))) << "n " << n << " value " << k;
      }
    };
    check(p, result.positions, 3);
    check(s, result.log_scales, 3);
    check(q, result.rotations, 4);
  }
}

TEST(SurfaceTerms, VanishOnTheSurface) {
  const auto context = compute::Context::open();
  const Gaussians g = random_discs(40, 3);
  SurfaceTerms terms(context, {1.0, 1.0, 0.0});
  DeviceGaussians device, gradients;
  device.upload(context, g);
  Gaussians zeros = g;
  for (auto* part : {&zeros.positions, &zeros.log_scales, &zeros.rotations}) part->assign(part->size(), 0.0F);
  gradients.upload(context, zeros);
  terms.add(device, {context, surface_anchors(g)}, gradients);
  const Gaussians result = gradients.download();
  for (const float v : result.positions) EXPECT_NEAR(v, 0.0F, 1e-6F);
  for (const float v : result.rotations) EXPECT_NEAR(v, 0.0F, 1e-6F);
}

TEST(SurfaceTerms, RefusesBadWeights) { EXPECT_THROW(SurfaceTermsOptions({-1.0, 0.0, 0.0}).check(), InputError); }

}  // namespace
}  // namespace odosplat
