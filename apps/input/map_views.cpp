// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "apps/input/map_views.hpp"

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "apps/input/cloud_files.hpp"
#include "apps/input/map_formats.hpp"
#include "apps/input/sampled_places.hpp"
#include "odosplat/core/error.hpp"
#include "odosplat/core/log.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/map/interpolation_view.hpp"
#include "odosplat/map/surfel_view.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/kept_gaussians.hpp"
#include "odosplat/splat/map_file.hpp"

namespace odosplat::apps {
namespace {

std::string needed(const std::string& method, const char* flag, const std::string& value) {
  if (value.empty()) throw InputError(flag, "is needed for method " + method);
  return value;
}

MapHalf half_of(const std::vector<Eigen::Vector3f>& points, const std::string& side) {
  const std::string axes = "xyz";
  const std::size_t axis = side.size() == 2 ? axes.find(side[1]) : std::string::npos;
  if (axis == std::string::npos || (side[0] != '+' && side[0] != '-')) {
    throw InputError("--without-half", "must be +x, -x, +y, -y, +z or -z, is " + side);
  }
  MapHalf half{static_cast<Eigen::Index>(axis), side[0] == '+' ? 1.0F : -1.0F, 0.0F};
  std::vector<float> along;
  along.reserve(points.size());
  for (const Eigen::Vector3f& p : points) along.push_back(half.sign * p[half.axis]);
  half.border = upper_median(std::move(along));
  return half;
}

std::vector<Eigen::Vector3f> positions(const Gaussians& gaussians) {
  std::vector<Eigen::Vector3f> points;
  points.reserve(gaussians.size());
  for (std::size_t i = 0; i < gaussians.size(); ++i) points.emplace_back(&gaussians.positions[3 * i]);
  return points;
}

Gaussians without_half(const Gaussians& gaussians, const std::string& side) {
  if (side.empty()) return gaussians;
  const std::vector<Eigen::Vector3f> points = positions(gaussians);
  const MapHalf half = half_of(points, side);
  std::vector<bool> keep(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) keep[i] = !half.contains(points[i]);
  return kept_gaussians(gaussians, keep);
}

PointCloud without_half(const PointCloud& cloud, const std::string& side) {
  if (side.empty()) return cloud;
  const MapHalf half = half_of(cloud.points, side);
  PointCloud kept;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (half.contains(cloud.points[i])) continue;
    kept.points.push_back(cloud.points[i]);
    if (cloud.has_colors()) kept.colors.push_back(cloud.colors[i]);
    if (cloud.has_normals()) kept.normals.push_back(cloud.normals[i]);
  }
  return kept;
}

}  // namespace

void add_map_flags(CLI::App* command, MapFlags& flags) {
  command->add_option("--map", flags.map, std::string("map of Gaussians (") + map_formats + ")");
  command->add_option("--depth", flags.depth,
                      "what the depth of a pixel is: surface, expected, median or blended (default: the method's)");
  command->add_option("--cloud", flags.cloud, cloud_formats);
}

void add_depth_noise_flag(CLI::App* command, DepthNoiseFlags& flags) {
  command
      ->add_option("--depth-noise", flags.model,
                   "noise added to the depth images of method rgbd: none, or kinect (axial, lateral, quantised; "
                   "missing outside 0.5 to 5 m, at grazing angles and at depth edges)")
      ->check(CLI::IsMember({"none", "kinect"}));
}

void OpenedView::show_frame(const Sequence& sequence, std::size_t i) {
  if (sensor == nullptr) return;
  DepthImage depth = sequence.has_depth(i) ? sequence.depth(i) : DepthImage();
  if (depth_noise && !depth.empty()) {
    depth = sense_kinect_depth(depth, sequence.camera(), *depth_noise, static_cast<int>(i));
  }
  sensor->set_depth(depth);
}

OpenedView open_view(const Common& common, const std::string& method, const MapFlags& flags,
                     const DepthNoiseFlags& noise) {
  const MethodPreset& preset = method_preset(method);
  OpenedView opened;
  switch (preset.view) {
    case ViewKind::gaussians: {
      Map map = read_map(needed(method, "--map", flags.map));
      map.gaussians = without_half(map.gaussians, flags.without_half);
      const std::optional<MapQuality>& quality = map.header.quality;
      if (quality && !quality->good) log_warning(flags.map + ": its header says: " + quality->verdict);
      opened.device = open_device(common);
      opened.view = std::make_unique<GaussianView>(*opened.device, map,
                                                   flags.depth.empty() ? preset.depth_mode : depth_mode(flags.depth));
      break;
    }
    case ViewKind::interpolation:
      opened.view = std::make_unique<InterpolationView>(
          without_half(read_point_cloud(needed(method, "--cloud", flags.cloud)), flags.without_half));
      break;
    case ViewKind::surfels:
      opened.view = std::make_unique<SurfelView>(
          without_half(read_point_cloud(needed(method, "--cloud", flags.cloud)), flags.without_half));
      break;
    case ViewKind::sensor: {
      auto view = std::make_unique<SensorView>();
      opened.sensor = view.get();
      opened.view = std::move(view);
      if (noise.model == "kinect") opened.depth_noise.emplace().seed = noise.seed;
      break;
    }
  }
  return opened;
}

void check_flags_of_method(const std::string& method, const MapFlags& flags, const DepthNoiseFlags& noise) {
  const MethodPreset& preset = method_preset(method);
  const std::string not_used = "is not used by method " + method;
  if (noise.model != "none" && preset.view != ViewKind::sensor) {
    throw InputError("--depth-noise", not_used + ": it is for the depth images of method rgbd");
  }
  if (preset.view != ViewKind::gaussians) {
    if (!flags.depth.empty()) throw InputError("--depth", not_used + ": it is for maps of Gaussians");
    return;
  }
  if (!flags.cloud.empty()) log_warning("--cloud " + not_used);
  if (method != "paper" || flags.map.empty()) return;
  const std::vector<std::string> notes = read_map_header(flags.map).notes;
  if (std::find(notes.begin(), notes.end(), "position_length gaussian_size") != notes.end()) {
    log_warning(flags.map + ": was trained with the default preset; the paper's recipe is train --preset paper");
  }
}

MapHalf map_half(const MapFlags& flags, const std::string& side) {
  return half_of(flags.map.empty() ? read_point_cloud(flags.cloud).points : positions(read_map(flags.map).gaussians),
                 side);
}

MapPoints read_map_points(const MapFlags& flags) {
  MapPoints points;
  if (flags.map.empty()) {
    if (!flags.cloud.empty()) points.cloud = read_point_cloud(flags.cloud);
    return points;
  }
  const Gaussians g = read_map(flags.map).gaussians;
  const auto stride = static_cast<std::size_t>(3 * g.coefficients());
  for (std::size_t i = 0; i < g.size(); ++i) {
    if (!counts_as_surface(g, i)) continue;
    const Eigen::Map<const Eigen::Vector3f> log_scale(&g.log_scales[3 * i]);
    const float* q = &g.rotations[4 * i];
    const Eigen::Quaternionf rotation = Eigen::Quaternionf(q[0], q[1], q[2], q[3]).normalized();
    int thin = 0;
    log_scale.minCoeff(&thin);
    std::array<float, 3> sorted{log_scale[0], log_scale[1], log_scale[2]};
    std::sort(sorted.begin(), sorted.end());
    const Eigen::Vector3f sh(g.sh[stride * i], g.sh[stride * i + 1], g.sh[stride * i + 2]);
    points.cloud.points.emplace_back(Eigen::Map<const Eigen::Vector3f>(&g.positions[3 * i]));
    points.cloud.colors.emplace_back(
        (sh_constant * sh + Eigen::Vector3f::Constant(0.5F)).cwiseMax(0.0F).cwiseMin(1.0F));
    points.cloud.normals.emplace_back(rotation * Eigen::Vector3f::Unit(thin));
    points.radii.push_back(std::exp(0.5F * (sorted[1] + sorted[2])));
  }
  return points;
}

}  // namespace odosplat::apps
