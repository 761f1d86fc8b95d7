// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/eval/convention_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "odosplat/core/error.hpp"
#include "odosplat/core/parallel.hpp"
#include "odosplat/eval/convention_verdict.hpp"

namespace odosplat {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double enough_overlap = 0.5;  // share of a pair's pixels from which a misfit is significant
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Pair {
  std::size_t from = 0;
  std::size_t to = 0;
};

struct Sample {
  Eigen::Vector3d ray;  // z = 1
  double depth;         // [m] by the declared scale
};

struct PairError {
  bool tried = false;
  double absolute = not_a_number;
  double relative = not_a_number;
  double overlap = 0.0;
};

std::vector<Convention> all_conventions(const Convention& declared, const ConventionOptions& options) {
  std::vector<double> scales{declared.depth_scale};
  for (const double scale : options.depth_scales) {
    if (std::find(scales.begin(), scales.end(), scale) == scales.end()) scales.push_back(scale);
  }
  std::vector<Convention> all;
  for (const int sign : {declared.fy_sign, -declared.fy_sign}) {
    for (const bool inverted : {false, true}) {
      for (const int shift : {0, -1, 1}) {
        for (const double scale : scales) all.push_back({sign, inverted, shift, scale});
      }
    }
  }
  return all;
}

const SE3* pose_of(const ConventionInput& input, std::size_t image, int shift) {
  const auto k = static_cast<std::ptrdiff_t>(image) + shift;
  if (k < 0 || k >= static_cast<std::ptrdiff_t>(input.T_world_camera.size())) return nullptr;
  const std::optional<SE3>& pose = input.T_world_camera[static_cast<std::size_t>(k)];
  return pose ? &*pose : nullptr;
}

struct Gaps {
  int min = 0;
  int max = 0;
};

Gaps first_gaps(int images, int gap) {
  if (images >= 2 * gap) return {gap, gap};
  return {std::max(1, images / 3), std::max(1, images - 1)};
}

// Pairs of images that have poses: under every shift of the ids, or only without a shift.
std::vector<Pair> choose_pairs(const ConventionInput& input, const Gaps& gaps, int wanted, bool under_every_shift) {
  std::vector<Pair> possible;
  for (int gap = gaps.min; gap <= gaps.max; ++gap) {
    const auto step = static_cast<std::size_t>(gap);
    const auto usable = [&](std::size_t i, int shift) {
      return pose_of(input, i, shift) && pose_of(input, i + step, shift);
    };
    for (std::size_t i = 0; i + step < input.T_world_camera.size(); ++i) {
      if (usable(i, 0) && (!under_every_shift || (usable(i, -1) && usable(i, 1)))) possible.push_back({i, i + step});
    }
  }
  const auto count = std::min(possible.size(), static_cast<std::size_t>(wanted));
  std::vector<Pair> pairs;
  for (std::size_t k = 0; k < count; ++k) pairs.push_back(possible[k * possible.size() / count]);
  return pairs;
}

std::vector<Sample> take_samples(const DepthImage& depth, const Camera& camera, int wanted) {
  const double per_sample = static_cast<double>(depth.total()) / wanted;
  const int step = std::max(1, static_cast<int>(std::sqrt(per_sample)));
  std::vector<Sample> samples;
  for (int y = step / 2; y < depth.rows; y += step) {
    for (int x = step / 2; x < depth.cols; x += step) {
      const double z = depth(y, x);
      if (z > 0.0 && std::isfinite(z)) samples.push_back({camera.ray(x, y), z});
    }
  }
  return samples;
}

PairError reproject(const ConventionInput& input, const Pair& pair, const std::vector<Sample>& samples,
                    const DepthImage& depth_to, const Convention& convention, double min_overlap) {
  PairError error;
  const SE3* from = pose_of(input, pair.from, convention.id_shift);
  const SE3* to = pose_of(input, pair.to, convention.id_shift);
  error.tried = from && to;
  if (!error.tried || samples.empty()) return error;
  SE3 T_to_from = convention.inverted ? *to * from->inverse() : to->inverse() * *from;
  if (convention.fy_sign < 0) T_to_from = reflected(T_to_from);
  const double metres = input.depth_scale / convention.depth_scale;
  std::vector<double> absolute;
  std::vector<double> relative;
  absolute.reserve(samples.size());
  relative.reserve(samples.size());
  for (const Sample& sample : samples) {
    const Eigen::Vector3d p_to = T_to_from * (metres * sample.depth * sample.ray);
    if (!(p_to.z() > 0.0)) continue;
    const Eigen::Vector2d pixel = input.camera.project(p_to);
    // Compared as doubles: wrong poses can put a pixel beyond the range of int.
    if (!(pixel.x() >= -0.5 && pixel.y() >= -0.5 && pixel.x() < depth_to.cols - 0.5 &&
          pixel.y() < depth_to.rows - 0.5)) {
      continue;
    }
    const double there = metres * static_cast<double>(depth_to(static_cast<int>(std::floor(pixel.y() + 0.5)),
                                                               static_cast<int>(std::floor(pixel.x() + 0.5))));
    if (!(there > 0.0) || !std::isfinite(there)) continue;
    absolute.push_back(std::abs(p_to.z() - there));
    relative.push_back(absolute.back() / there);
  }
  error.overlap = static_cast<double>(relative.size()) / static_cast<double>(samples.size());
  if (relative.empty() || error.overlap < min_overlap) return error;
  error.absolute = median_of(std::move(absolute));
  error.relative = median_of(std::move(relative));
  return error;
}

// The largest overlap of the rows that could be measured; 0 if there are none.
double most_overlap(const std::vector<ConventionRow>& rows) {
  double most = 0.0;
  for (const ConventionRow& row : rows) {
    if (std::isfinite(row.relative_error)) most = std::max(most, row.overlap);
  }
  return most;
}

DepthImage load(const ConventionInput& input, std::size_t image) {
  DepthImage depth = input.depth(image);
  if (depth.cols != input.camera.width || depth.rows != input.camera.height) {
    throw InputError("depth of image " + std::to_string(image), "is not of the camera's size");
  }
  return depth;
}

// One row per convention, not sorted.
std::vector<ConventionRow> measure(const ConventionInput& input, const std::vector<Convention>& conventions,
                                   const std::vector<Pair>& pairs, const ConventionOptions& options) {
  std::vector<std::vector<PairError>> errors(conventions.size(), std::vector<PairError>(pairs.size()));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::vector<Sample> samples = take_samples(load(input, pairs[k].from), input.camera, options.samples);
    const DepthImage depth_to = load(input, pairs[k].to);
    parallel_for(static_cast<int>(conventions.size()), 4, [&](int begin, int end) {
      for (int c = begin; c < end; ++c) {
        const auto at = static_cast<std::size_t>(c);
        errors[at][k] = reproject(input, pairs[k], samples, depth_to, conventions[at], options.min_overlap);
      }
    });
  }
  std::vector<ConventionRow> rows;
  for (std::size_t c = 0; c < conventions.size(); ++c) {
    ConventionRow row;
    row.convention = conventions[c];
    std::vector<double> absolute;
    std::vector<double> relative;
    std::size_t tried = 0;
    for (const PairError& e : errors[c]) {
      tried += e.tried;
      row.pair_errors.push_back(e.relative);
      row.overlap += e.overlap / static_cast<double>(pairs.size());
      if (std::isnan(e.relative)) continue;
      absolute.push_back(e.absolute);
      relative.push_back(e.relative);
    }
    row.tried = 2 * tried >= pairs.size();
    const bool enough = !relative.empty() && 2 * relative.size() >= pairs.size();
    row.error_m = enough ? median_of(std::move(absolute)) : infinity;
    row.relative_error = enough ? median_of(std::move(relative)) : infinity;
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace

void ConventionOptions::check() const {
  require(gap >= 1, "gap", "at least 1 frame");
  require(pairs >= 1, "pairs", "at least 1");
  require(samples >= 100, "samples", "at least 100");
  require(min_overlap > 0.0 && min_overlap <= 1.0, "min_overlap", "in 0..1");
  require(max_error > 0.0, "max_error", "positive");
  for (const double scale : depth_scales) {
    require(std::isfinite(scale) && scale > 0.0, "depth_scales", "positive");
  }
}

ConventionReport check_conventions(const ConventionInput& input, const ConventionOptions& options) {
  options.check();
  input.camera.check();
  require(input.fy_sign == 1 || input.fy_sign == -1, "fy_sign", "+1 or -1");
  require(std::isfinite(input.depth_scale) && input.depth_scale > 0.0, "depth_scale", "positive");
  const auto posed = std::count_if(input.T_world_camera.begin(), input.T_world_camera.end(),
                                   [](const std::optional<SE3>& pose) { return pose.has_value(); });
  if (posed < 2) throw InputError("sequence", "has " + std::to_string(posed) + " images with pose, 2 are needed");

  ConventionReport report;
  report.declared = {input.fy_sign, false, 0, input.depth_scale};
  const std::vector<Convention> conventions = all_conventions(report.declared, options);
  const int images = static_cast<int>(input.T_world_camera.size());
  // Stops at the first, that is the largest, gap with a result: a row is believable, or the images overlap enough but
  // no row fits. Smaller gaps are avoided because with little motion wrong rows fit too. Without a result the gap with
  // the largest overlap is kept.
  const auto try_gaps = [&](bool under_every_shift) {
    const Gaps first = first_gaps(images, options.gap);
    for (Gaps gaps = first; gaps.min >= 1; gaps = {gaps.min / 2, gaps.max / 2}) {
      const std::vector<Pair> pairs = choose_pairs(input, gaps, options.pairs, under_every_shift);
      if (pairs.empty()) continue;
      ConventionReport tried = report;
      tried.gap = gaps.min;
      tried.max_gap = gaps.max;
      tried.gap_reduced = gaps.min < first.min;
      tried.pairs = static_cast<int>(pairs.size());
      tried.rows = measure(input, conventions, pairs, options);
      const bool believable = std::any_of(tried.rows.begin(), tried.rows.end(), [&](const ConventionRow& row) {
        return row.relative_error <= options.max_error;
      });
      const bool enough = tried.rows.front().overlap >= enough_overlap;  // the declared convention is tried first
      if (believable || enough || most_overlap(tried.rows) > most_overlap(report.rows)) report = std::move(tried);
      if (believable || (enough && most_overlap(report.rows) > 0.0)) return true;
    }
    return !report.rows.empty();
  };
  if (!try_gaps(true) && !try_gaps(false)) {
    throw InputError(
        "sequence",
        "no two images show the same surfaces under any convention, so that the conventions cannot be checked");
  }
  std::stable_sort(report.rows.begin(), report.rows.end(),
                   [](const ConventionRow& a, const ConventionRow& b) { return a.relative_error < b.relative_error; });
  judge_conventions(report, input.camera, options.max_error);
  return report;
}

}  // namespace odosplat
