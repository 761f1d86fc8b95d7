// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/edit/merge.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "odosplat/core/error.hpp"
#include "odosplat/core/formatted.hpp"
#include "odosplat/core/upper_median.hpp"
#include "odosplat/splat/edit/edited_header.hpp"
#include "odosplat/splat/edit/merge_layer.hpp"
#include "odosplat/splat/kept_gaussians.hpp"

namespace odosplat {
namespace {

/// One of two layers in one patch.
struct Side {
  std::size_t count = 0;    // solid Gaussians
  std::size_t covered = 0;  // of these by the other layer
  std::vector<float> sigmas;
};

std::vector<Side> sides_of(const MergeLayer& layer, const std::vector<int>& patches, std::size_t count,
                           const std::vector<bool>& is_covered) {
  std::vector<Side> sides(count);
  for (std::size_t i = 0; i < layer.size(); ++i) {
    if (layer.solid[i] == 0) continue;
    Side& side = sides[static_cast<std::size_t>(patches[i])];
    ++side.count;
    if (is_covered[i]) ++side.covered;
    side.sigmas.push_back(layer.sigmas[i]);
  }
  return sides;
}

/// Share of the other side's Gaussians that a side covers; 1 if the other has none.
double cover_of(const Side& other) {
  return other.count == 0 ? 1.0 : static_cast<double>(other.covered) / static_cast<double>(other.count);
}

/// Whether b is to be taken in a patch instead of a.
bool takes_b(const Side& a, const Side& b, const MergeOptions& options) {
  if (a.count == 0 || b.count == 0) return a.count == 0;
  const bool a_complete = cover_of(b) >= options.complete_share;
  const bool b_complete = cover_of(a) >= options.complete_share;
  if (a_complete != b_complete) return b_complete;
  const auto sigma_a = static_cast<double>(upper_median(a.sigmas));
  const auto sigma_b = static_cast<double>(upper_median(b.sigmas));
  if (sigma_a * options.better < sigma_b) return false;
  if (sigma_b * options.better < sigma_a) return true;
  return static_cast<double>(b.count) > options.better * static_cast<double>(a.count);
}

/// Which Gaussians of two layers stay.
struct Choice {
  std::vector<bool> a;
  std::vector<bool> b;
};

Choice choose(const MergeLayer& a, const MergeLayer& b, const MergeOptions& options) {
  std::vector<float> spacings = a.spacings;
  spacings.insert(spacings.end(), b.spacings.begin(), b.spacings.end());
  const auto radius = options.patch_spacings * static_cast<double>(upper_median(std::move(spacings)));
  const MergePatches patches = merge_patches(a, b, std::max(radius, 1e-6));
  const std::vector<bool> all_a(a.size(), true);
  const std::vector<bool> all_b(b.size(), true);
  const std::vector<Side> sides_a = sides_of(a, patches.of_a, patches.count, covered(a, b, all_b, options));
  const std::vector<Side> sides_b = sides_of(b, patches.of_b, patches.count, covered(b, a, all_a, options));
  std::vector<bool> b_taken(patches.count);
  for (std::size_t k = 0; k < patches.count; ++k) b_taken[k] = takes_b(sides_a[k], sides_b[k], options);
  // What is taken stays whole. Only that may stand for what is dropped: otherwise both could be dropped at a seam.
  Choice choice{std::vector<bool>(a.size()), std::vector<bool>(b.size())};
  for (std::size_t i = 0; i < a.size(); ++i) choice.a[i] = !b_taken[static_cast<std::size_t>(patches.of_a[i])];
  for (std::size_t i = 0; i < b.size(); ++i) choice.b[i] = b_taken[static_cast<std::size_t>(patches.of_b[i])];
  const std::vector<bool> a_covered = covered(a, b, choice.b, options);
  const std::vector<bool> b_covered = covered(b, a, choice.a, options);
  for (std::size_t i = 0; i < a.size(); ++i) choice.a[i] = choice.a[i] || !a_covered[i];
  for (std::size_t i = 0; i < b.size(); ++i) choice.b[i] = choice.b[i] || !b_covered[i];
  return choice;
}

/// A warning, or an InputError unless forced.
void refuse(const std::string& name, const std::string& fault, bool force, std::vector<std::string>& warnings) {
  if (!force) throw InputError(name, fault + " (--force merges them all the same)");
  warnings.push_back(name + ": " + fault);
}

void judge(const std::string& name, const MergeOverlap& overlap, const MergeOptions& options,
           std::vector<std::string>& warnings) {
  constexpr std::size_t least_pairs = 100;
  if (overlap.pairs < least_pairs) {
    warnings.push_back(name + ": holds no surface of the maps before it: whether it is of the same frame is not known");
    return;
  }
  const std::string apart =
      "its surfaces lie " + formatted("%.1f mm (%.1f sigma)", 1000.0 * overlap.distance_m, overlap.sigmas) +
      " off those of the maps before it (median along the normals); likely cause: different frames (run align), or "
      "things that moved";
  const std::string light = "it is " + formatted("%.2f", std::abs(overlap.gray)) +
                            (overlap.gray > 0.0 ? " brighter" : " darker") +
                            " (of 1) than the maps before it; likely cause: another exposure or light";
  if (overlap.sigmas > options.most_sigmas) {
    refuse(name, apart, options.force, warnings);
  } else if (overlap.sigmas > options.warn_sigmas) {
    warnings.push_back(name + ": " + apart);
  }
  for (std::size_t axis = 0; axis < overlap.unmet.size(); ++axis) {
    if (!overlap.unmet[axis]) continue;
    warnings.push_back(name + ": surfaces that face " + "xyz"[axis] +
                       " do not meet: the maps may be of different frames (align)");
  }
  if (std::abs(overlap.gray) > options.most_gray) {
    refuse(name, light, options.force, warnings);
  } else if (std::abs(overlap.gray) > options.warn_gray) {
    warnings.push_back(name + ": " + light);
  }
}

/// What of the way it is rendered differs between two maps; empty: nothing.
std::string difference(const RasterizerOptions& a, const RasterizerOptions& b) {
  if (a.order != b.order) return "the order of blending";
  if (a.dilation != b.dilation) return "dilation";
  if (a.compensated != b.compensated) return "compensation of opacity";
  return {};
}

void check_sources(const std::vector<MergeSource>& sources, const MergeOptions& options,
                   std::vector<std::string>& warnings) {
  require(sources.size() >= 2, "maps to merge", "at least two");
  for (const MergeSource& source : sources) {
    source.map.gaussians.check();
    if (source.map.gaussians.empty()) throw InputError(source.name, "has no Gaussians");
    const std::string differs = difference(sources.front().map.header.rasterizer, source.map.header.rasterizer);
    if (differs.empty()) continue;
    refuse(source.name,
           differs + " is not that of " + sources.front().name + ": in one map its colours or its depth would be off",
           options.force, warnings);
  }
}

}  // namespace

void MergeOptions::check() const {
  require(sigmas >= 0.0, "sigmas", "at least 0");
  require(spacings >= 0.0, "spacings", "at least 0");
  require(patch_spacings > 0.0, "patch_spacings", "positive");
  require(complete_share >= 0.0 && complete_share <= 1.0, "complete_share", "in 0..1");
  require(better >= 1.0, "better", "at least 1");
  require(warn_sigmas > 0.0 && most_sigmas >= warn_sigmas, "most_sigmas", "at least warn_sigmas, which is positive");
  require(warn_gray > 0.0 && most_gray >= warn_gray, "most_gray", "at least warn_gray, which is positive");
}

MergedMap merge_maps(const std::vector<MergeSource>& sources, const MergeOptions& options,
                     const std::function<void(const std::string& name)>& notice) {
  options.check();
  MergedMap merged;
  check_sources(sources, options, merged.warnings);
  MergeLayer all;                  // of the maps so far, those that stay
  std::vector<std::size_t> owner;  // the source of each
  std::vector<std::size_t> row;    // its number there
  for (std::size_t k = 0; k < sources.size(); ++k) {
    if (notice) notice(sources[k].name);
    const MergeLayer layer = merge_layer(sources[k].map);
    Choice choice{{}, std::vector<bool>(layer.size(), true)};
    if (k > 0) {
      merged.overlaps.push_back(compare_surfaces(layer, all));
      judge(sources[k].name, merged.overlaps.back(), options, merged.warnings);
      choice = choose(all, layer, options);
    }
    MergeLayer next;
    next.append(all, choice.a);
    next.append(layer, choice.b);
    std::size_t count = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!choice.a[i]) continue;
      owner[count] = owner[i];
      row[count++] = row[i];
    }
    owner.resize(count);
    row.resize(count);
    for (std::size_t i = 0; i < layer.size(); ++i) {
      if (!choice.b[i]) continue;
      owner.push_back(k);
      row.push_back(i);
    }
    all = std::move(next);
  }
  std::vector<HeaderSource> headers;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    const Gaussians& gaussians = sources[k].map.gaussians;
    std::vector<bool> keep(gaussians.size(), false);
    for (std::size_t i = 0; i < owner.size(); ++i) {
      if (owner[i] == k) keep[row[i]] = true;
    }
    append_gaussians(merged.map.gaussians, kept_gaussians(gaussians, keep));
    merged.kept.push_back(static_cast<std::size_t>(std::count(owner.begin(), owner.end(), k)));
    headers.push_back({sources[k].name, sources[k].map.header, gaussians.size(), merged.kept.back()});
  }
  merged.map.header = merged_header(headers);
  return merged;
}

}  // namespace odosplat
