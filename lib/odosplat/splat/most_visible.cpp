// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/most_visible.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "kernels/constants.h"

namespace odosplat {
namespace {

constexpr std::size_t most_cameras = 100;
constexpr double least_distance = 0.1;  // [m]

std::vector<Eigen::Vector3d> places_of_cameras(const std::vector<SE3>& cameras) {
  std::vector<Eigen::Vector3d> places;
  const std::size_t count = std::min(cameras.size(), most_cameras);
  for (std::size_t k = 0; k < count; ++k) places.push_back(cameras[k * cameras.size() / count].translation());
  return places;
}

double opacity_of(const Gaussians& gaussians, std::size_t i) {
  return 1.0 / (1.0 + std::exp(-static_cast<double>(gaussians.opacity_logits[i])));
}

double visibility_of(const Gaussians& gaussians, std::size_t i, const std::vector<Eigen::Vector3d>& places) {
  std::array<float, 3> log_scales{};
  std::copy_n(&gaussians.log_scales[3 * i], 3, log_scales.begin());
  std::sort(log_scales.begin(), log_scales.end());
  const double area = std::exp(static_cast<double>(log_scales[1]) + static_cast<double>(log_scales[2]));
  double views = places.empty() ? 1.0 : 0.0;
  const Eigen::Vector3d position = Eigen::Map<const Eigen::Vector3f>(&gaussians.positions[3 * i]).cast<double>();
  for (const Eigen::Vector3d& place : places) {
    views += 1.0 / std::max((position - place).squaredNorm(), least_distance * least_distance);
  }
  return opacity_of(gaussians, i) * area * views;
}

}  // namespace

VisibleGaussians most_visible(const Gaussians& gaussians, const std::vector<SE3>& cameras, std::size_t most) {
  VisibleGaussians kept;
  for (std::size_t i = 0; i < gaussians.size(); ++i) {
    if (opacity_of(gaussians, i) >= static_cast<double>(MIN_ALPHA)) kept.rows.push_back(i);
  }
  if (kept.rows.size() <= most) return kept;
  const std::vector<Eigen::Vector3d> places = places_of_cameras(cameras);
  std::vector<double> visibility(gaussians.size(), 0.0);
  double all = 0.0;
  for (const std::size_t i : kept.rows) {
    visibility[i] = visibility_of(gaussians, i, places);
    all += visibility[i];
  }
  std::stable_sort(kept.rows.begin(), kept.rows.end(),
                   [&](std::size_t a, std::size_t b) { return visibility[a] > visibility[b]; });
  kept.rows.resize(most);
  std::sort(kept.rows.begin(), kept.rows.end());
  double remaining = 0.0;
  for (const std::size_t i : kept.rows) remaining += visibility[i];
  kept.share = all > 0.0 ? remaining / all : 0.0;
  return kept;
}

}  // namespace odosplat
