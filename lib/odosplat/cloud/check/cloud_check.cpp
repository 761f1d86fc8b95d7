// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/cloud/check/cloud_check.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "odosplat/cloud/check/cloud_rows.hpp"
#include "odosplat/cloud/check/cloud_units.hpp"
#include "odosplat/cloud/check/cloud_verdict.hpp"
#include "odosplat/cloud/check/visible_patches.hpp"
#include "odosplat/core/error.hpp"

namespace odosplat {
namespace {

constexpr double good_error = 0.35;  // at which no smaller gap is looked at
constexpr double rows_share = 0.6;   // of the work; the fit takes the rest

// What patches are looked for a few pixels from where they should be can find. A fit that ends beyond that has followed
// a cloud of another shape: those were measured to end at 0.33 of the depth, 22 to 86 degrees, or 3.7 times the scale.
constexpr double reach_offset = 0.25;  // of the median depth
constexpr double reach_turn_deg = 15.0;
constexpr double reach_ln_scale = 0.25;

bool leaves_reach(const CloudFit& fit) {
  return fit.offset_m.value > reach_offset * fit.median_depth_m || fit.turn_deg.value > reach_turn_deg ||
         std::abs(std::log(fit.scale.value)) > reach_ln_scale;
}

// Whether the images that the pairs begin with show texture where the cloud is seen, under the best row.
bool is_textured(CloudMaterial& material, const CloudReading& reading, const std::vector<ImagePair>& pairs) {
  std::size_t textured = 0;
  for (const ImagePair& pair : pairs) {
    const std::optional<SE3> pose = material.pose(pair.from, reading);
    if (!pose) continue;
    const PatchWorld world = material.world(reading.mirrored);
    const std::vector<VisiblePatch> patches = visible_patches(*world.cloud, *world.spacings, material.gray(pair.from),
                                                              world.camera, *pose, static_cast<int>(least_patches));
    textured += patches.size() >= least_patches;
  }
  return 2 * textured >= pairs.size();
}

std::optional<CloudFit> fit_reading(CloudMaterial& material, const CloudCheckInput& input, const CloudReading& reading,
                                    int gap, const CloudCheckOptions& options) {
  CloudFitInput fit;
  const PatchWorld world = material.world(reading.mirrored);
  fit.camera = world.camera;
  for (std::size_t i = 0; i < input.T_world_camera.size(); ++i) {
    if (const std::optional<SE3> pose = material.pose(i, reading)) {
      fit.images.push_back(i);
      fit.T_world_camera.push_back(*pose);
    }
  }
  fit.gray = [&](std::size_t i) { return material.gray(i); };
  fit.cloud = world.cloud;
  fit.spacings = world.spacings;
  fit.progress = [&](double share) {
    if (input.progress) input.progress(rows_share + (1.0 - rows_share) * share);
  };
  CloudFit result = fit_cloud(fit, {gap, options.pairs, options.patches / 2});
  if (result.patches == 0) return std::nullopt;
  const double factor = input.camera.fx / world.camera.fx;
  result.focal_px = {factor * result.focal_px.value, factor * result.focal_px.sigma};
  return result;
}

// The control with the cloud moved, and the focal length changed, as was fitted.
CloudControl corrected_control(CloudMaterial& material, const CloudCheckReport& report, const Camera& camera,
                               const std::vector<ImagePair>& pairs, const CloudCheckOptions& options) {
  const CloudFit& fit = *report.fit;
  PatchWorld world = material.world(report.winner.mirrored);
  const PointCloud cloud = moved(*world.cloud, fit.world_from_cloud);
  std::vector<float> spacings = *world.spacings;
  for (float& s : spacings) s *= static_cast<float>(fit.world_from_cloud.scale);
  const double factor = fit.focal_px.value / camera.fx;
  world.cloud = &cloud;
  world.spacings = &spacings;
  world.camera.fx *= factor;
  world.camera.fy *= factor;
  return measure_control(material, world, report.winner, pairs, options);
}

// All that is measured of the cloud in its present unit; findings and verdict are left open.
CloudCheckReport examine(CloudMaterial& material, const CloudCheckInput& input, const CloudCheckOptions& options) {
  CloudCheckReport report;
  report.declared = {input.fy_sign, false, false, 0};
  std::vector<ImagePair> used;
  const auto progress = [&](double share) {
    if (input.progress) input.progress(rows_share * share);
  };
  const auto longest = static_cast<int>(std::max<std::size_t>(1, material.images() / 3));
  for (int gap = std::min(options.gap, longest); gap >= 1; gap /= 2) {
    const std::vector<ImagePair> pairs = choose_pairs(material, gap, options.pairs, options.max_shift);
    if (pairs.empty()) continue;
    std::vector<CloudRow> rows = measure_readings(material, report.declared, pairs, options, progress);
    const bool first = report.rows.empty();
    if (first) report.largest_gap_error = rows.front().relative_error;
    if (first || rows.front().relative_error < report.rows.front().relative_error) {
      report.textured = is_textured(material, rows.front().reading, pairs);
      report.rows = std::move(rows);
      report.gap = gap;
      report.pairs = static_cast<int>(pairs.size());
      used = pairs;
    }
    // Without any patch the length of the gap changes nothing.
    if (report.rows.front().relative_error <= good_error || material.patches() == 0) break;
  }
  if (report.rows.empty()) throw InputError("sequence", "no two images with pose are near each other in the list");
  choose_reading(report, options.max_error);
  if (!report.believable) return report;
  report.given = measure_control(material, material.world(report.winner.mirrored), report.winner, used, options);
  report.fit = fit_reading(material, input, report.winner, report.gap, options);
  if (report.fit) report.corrected = corrected_control(material, report, input.camera, used, options);
  return report;
}

}  // namespace

void CloudCheckOptions::check() const {
  require(gap >= 1, "gap", "at least 1 frame");
  require(pairs >= 1, "pairs", "at least 1");
  require(max_shift >= 0, "max_shift", "at least 0 frames");
  require(patches >= 100, "patches", "at least 100");
  require(min_overlap > 0.0 && min_overlap <= 1.0, "min_overlap", "in 0..1");
  require(max_error > 0.0, "max_error", "positive");
  require(most_points >= 100, "most_points", "at least 100");
  require(largest_width >= 32, "largest_width", "at least 32 pixels");
}

CloudCheckReport check_cloud(const CloudCheckInput& input, const CloudCheckOptions& options) {
  options.check();
  input.camera.check();
  require(input.fy_sign == 1 || input.fy_sign == -1, "fy_sign", "+1 or -1");
  const auto posed = std::count_if(input.T_world_camera.begin(), input.T_world_camera.end(),
                                   [](const std::optional<SE3>& pose) { return pose.has_value(); });
  if (posed < 2) throw InputError("sequence", "has " + std::to_string(posed) + " images with pose, 2 are needed");
  CloudMaterial material(input, options);
  CloudCheckReport report = examine(material, input, options);
  if (!report.fits() && !report.correction_gains()) {
    if (const std::optional<double> factor = likely_unit(material, report, options)) {
      material.set_cloud_scale(*factor);
      CloudCheckReport scaled = examine(material, input, options);
      scaled.unit = 1.0 / *factor;
      if (scaled.fits() || scaled.correction_gains()) report = std::move(scaled);
    }
  }
  judge_cloud(report, options, input.camera);
  return report;
}

bool CloudCheckReport::fits() const {
  return beats(given.cloud, given.flat) && beats(given.cloud, given.distant) && !(fit && leaves_reach(*fit));
}

bool CloudCheckReport::correction_gains() const {
  return corrected && !leaves_reach(*fit) && beats(corrected->cloud, given.cloud) &&
         beats(corrected->cloud, corrected->flat) && beats(corrected->cloud, corrected->distant);
}

}  // namespace odosplat
