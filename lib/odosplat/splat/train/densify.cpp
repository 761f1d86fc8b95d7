// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/train/densify.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "odosplat/core/error.hpp"

namespace odosplat {

namespace {

constexpr int most_in_one_place = 51;  // as in Kheradmand et al.: beyond, the alternating sum loses its precision
constexpr double split_shrinkage = 1.6;

float logit(double opacity) { return static_cast<float>(std::log(opacity / (1.0 - opacity))); }
double opacity_of(const Gaussians& g, std::size_t i) {
  return 1.0 / (1.0 + std::exp(-static_cast<double>(g.opacity_logits[i])));
}

/// Every array of floats that has a row for each Gaussian, with the length of a row.
std::vector<std::pair<std::vector<float>*, std::size_t>> columns(TrainingRows& rows) {
  Gaussians& g = rows.gaussians;
  return {{&g.positions, 3},
          {&g.log_scales, 3},
          {&g.rotations, 4},
          {&g.opacity_logits, 1},
          {&g.sh, 3 * static_cast<std::size_t>(g.coefficients())},
          {&rows.largest_log_scales, 3},
          {&rows.anchors, 8}};
}

template <typename T>
void copy_row(std::vector<T>& values, std::size_t from, std::size_t to, std::size_t stride) {
  std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(from * stride), stride,
              values.begin() + static_cast<std::ptrdiff_t>(to * stride));
}

template <typename T>
void keep_rows(std::vector<T>& values, const std::vector<bool>& keep, std::size_t stride) {
  std::size_t to = 0;
  for (std::size_t i = 0; i < keep.size(); ++i)
    if (keep[i]) copy_row(values, i, to++, stride);
  values.resize(to * stride);
}

/// Row `to` becomes a copy of row `from`.
void overwrite(TrainingRows& rows, std::size_t to, std::size_t from) {
  for (const auto& [values, stride] : columns(rows))
    if (!values->empty()) copy_row(*values, from, to, stride);
  rows.from[to] = -1;
}

/// Moves row i by a random step along its first `axes` axes, drawn from the Gaussian `stretch` times its size.
void scatter(TrainingRows& rows, std::size_t i, std::size_t axes, double stretch, Random& random) {
  float shift[3] = {0.0F, 0.0F, 0.0F};
  for (std::size_t a = 0; a < axes; ++a)
    shift[a] = static_cast<float>(stretch * random.normal() *
                                  std::exp(static_cast<double>(rows.gaussians.log_scales[3 * i + a])));
  rows.move(i, shift);
}

double largest_axis(const Gaussians& g, std::size_t i) {
  return std::exp(
      static_cast<double>(std::max({g.log_scales[3 * i], g.log_scales[3 * i + 1], g.log_scales[3 * i + 2]})));
}

}  // namespace

DensifyMethod densify_method(const std::string& name) {
  if (name == "none") return DensifyMethod::none;
  if (name == "relocate") return DensifyMethod::relocate;
  if (name == "split") return DensifyMethod::split;
  throw InputError("densify", "must be none, relocate or split, is \"" + name + "\"");
}

std::string name_of(DensifyMethod method) {
  switch (method) {
    case DensifyMethod::relocate:
      return "relocate";
    case DensifyMethod::split:
      return "split";
    case DensifyMethod::none:
      break;
  }
  return "none";
}

void DensifyOptions::check() const {
  require(from >= 0, "densify_from", "at least 0");
  require(interval >= 1, "densify_interval", "at least 1");
  require(until_share >= 0.0 && until_share <= 1.0, "densify_until_share", "in 0..1");
  require(dead_opacity >= 0.0 && dead_opacity < 1.0, "dead_opacity", "at least 0, below 1");
  require(growth >= 0.0 && growth <= 1.0, "densify_growth", "in 0..1");
  require(pull > 0.0, "densify_pull", "positive");
  require(split_size > 0.0, "split_size", "positive");
  require(least_split_px >= 0.0, "least_split_px", "at least 0");
  require(most_split_px > 0.0 && most_split_px >= least_split_px, "most_split_px",
          "positive and no less than the least");
  require(largest_size > 0.0, "largest_size", "positive");
  require(reset_interval == 0 || reset_interval > 100, "reset_interval", "0 or above 100");
  require(reset_opacity > 0.0 && reset_opacity < 1.0, "reset_opacity", "between 0 and 1");
}

std::size_t TrainingRows::append_copy(std::size_t i) {
  const std::size_t to = size();
  for (const auto& [values, stride] : columns(*this)) {
    if (values->empty()) continue;
    values->resize((to + 1) * stride);
    copy_row(*values, i, to, stride);
  }
  from.push_back(-1);
  return to;
}

void TrainingRows::move(std::size_t i, const float shift[3]) {
  const float* q = &gaussians.rotations[4 * i];
  const Eigen::Vector3f moved = Eigen::Quaternionf(q[0], q[1], q[2], q[3]).normalized() * Eigen::Vector3f(shift);
  for (std::size_t a = 0; a < 3; ++a) {
    gaussians.positions[3 * i + a] += moved[static_cast<Eigen::Index>(a)];
    if (!anchors.empty()) anchors[8 * i + a] += moved[static_cast<Eigen::Index>(a)];
  }
}

void TrainingRows::keep(const std::vector<bool>& wanted) {
  for (const auto& [values, stride] : columns(*this))
    if (!values->empty()) keep_rows(*values, wanted, stride);
  keep_rows(from, wanted, 1);
}

double relocated_size_ratio(double opacity, double shared_opacity, int n) {
  double sum = 0.0;
  for (int i = 1; i <= n; ++i) {
    double binomial = 1.0;
    double power = shared_opacity;
    for (int k = 0; k < i; ++k) {
      sum += binomial * power / std::sqrt(k + 1.0);
      binomial *= static_cast<double>(i - 1 - k) / (k + 1);
      power *= -shared_opacity;
    }
  }
  return sum > 0.0 ? opacity / sum : 1.0;
}

void relocate(TrainingRows& rows, const DensifyOptions& options, Random& random) {
  std::vector<std::size_t> alive;
  std::vector<std::size_t> dead;
  std::vector<double> sums;
  double sum = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double opacity = opacity_of(rows.gaussians, i);
    if (opacity <= options.dead_opacity) {
      dead.push_back(i);
      continue;
    }
    alive.push_back(i);
    sums.push_back(sum += opacity);
  }
  const auto grown = static_cast<std::size_t>(std::ceil((1.0 + options.growth) * static_cast<double>(rows.size())));
  const std::size_t wanted = std::max(rows.size(), std::min(options.budget, grown));
  const std::size_t copies = dead.size() + wanted - rows.size();
  if (alive.empty() || copies == 0) return;

  std::vector<int> sharing(rows.size(), 1);
  std::vector<std::size_t> sources(copies);
  for (std::size_t& source : sources) {
    const auto at = std::upper_bound(sums.begin(), sums.end(), random.uniform() * sum) - sums.begin();
    source = alive[std::min(static_cast<std::size_t>(at), alive.size() - 1)];
    sharing[source] = std::min(sharing[source] + 1, most_in_one_place);
  }
  for (const std::size_t i : alive) {
    if (sharing[i] == 1) continue;
    const double opacity = std::min(opacity_of(rows.gaussians, i), 0.9999);
    const double shared =
        std::max(1.0 - std::pow(1.0 - opacity, 1.0 / sharing[i]), std::min(opacity, 1.01 * options.dead_opacity));
    const double ratio = relocated_size_ratio(opacity, shared, sharing[i]);
    rows.gaussians.opacity_logits[i] = logit(shared);
    for (std::size_t a = 0; a < 2; ++a) rows.gaussians.log_scales[3 * i + a] += static_cast<float>(std::log(ratio));
    rows.from[i] = -1;
  }
  for (std::size_t k = 0; k < copies; ++k) {
    std::size_t to = 0;
    if (k < dead.size()) {
      to = dead[k];
      overwrite(rows, to, sources[k]);
    } else {
      to = rows.append_copy(sources[k]);
    }
    scatter(rows, to, 2, 1.0, random);  // in its plane: the surface stays where it is
  }
}

DensifySizes densify_sizes(const DensifyOptions& options, double camera_extent, double pixel, bool growth_limited) {
  DensifySizes sizes{options.split_size * camera_extent, options.largest_size * camera_extent};
  if (pixel > 0.0) sizes.split = std::clamp(sizes.split, options.least_split_px * pixel, options.most_split_px * pixel);
  if (growth_limited) sizes.largest = std::numeric_limits<double>::infinity();
  return sizes;
}

void clone_and_split(TrainingRows& rows, const DensifyOptions& options, const DensifySizes& sizes,
                     const std::vector<float>& pulls, const std::vector<float>& seen, Random& random) {
  const std::size_t n = rows.size();
  const auto mean_pull = [&](std::size_t i) { return seen[i] > 0.0F ? pulls[i] / seen[i] : 0.0F; };
  std::vector<std::size_t> pulled;
  for (std::size_t i = 0; i < n; ++i)
    if (static_cast<double>(mean_pull(i)) > options.pull) pulled.push_back(i);
  std::stable_sort(pulled.begin(), pulled.end(),
                   [&](std::size_t a, std::size_t b) { return mean_pull(a) > mean_pull(b); });
  if (options.budget > 0) pulled.resize(std::min(pulled.size(), options.budget > n ? options.budget - n : 0));

  for (const std::size_t i : pulled) {
    const bool split = largest_axis(rows.gaussians, i) > sizes.split;
    if (split) {
      for (std::size_t a = 0; a < 3; ++a)
        rows.gaussians.log_scales[3 * i + a] -= static_cast<float>(std::log(split_shrinkage));
    }
    const std::size_t copy = rows.append_copy(i);
    if (!split) continue;
    // Both halves are placed at random within the whole.
    for (const std::size_t half : {i, copy}) {
      scatter(rows, half, 3, split_shrinkage, random);
      rows.from[half] = -1;
    }
  }
  std::vector<bool> wanted(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    wanted[i] =
        opacity_of(rows.gaussians, i) >= options.dead_opacity && largest_axis(rows.gaussians, i) <= sizes.largest;
  // If none would be left, all are kept.
  if (std::find(wanted.begin(), wanted.end(), true) != wanted.end()) rows.keep(wanted);
}

}  // namespace odosplat
