// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "odosplat/core/random.hpp"
#include "odosplat/splat/gaussians.hpp"

namespace odosplat {

/// How Gaussians are added, moved and removed during training.
enum class DensifyMethod {
  none,      // the Gaussians of the start are kept
  relocate,  // almost transparent ones are moved onto others, and new ones are added there, up to the budget
  split      // clone and split by the gradient of the loss on the screen; prune; opacity resets if asked for
};

struct DensifyOptions {
  DensifyMethod method = DensifyMethod::none;
  std::size_t budget = 0;       // most Gaussians, 0: relocate adds none, split has no limit
  int from = 500;               // first iteration
  int interval = 100;           // iterations between two rounds, >= 1
  double until_share = 0.8;     // share of all iterations after which it ends, 0..1
  double dead_opacity = 0.02;   // relocate: moved, split: removed below this, 0..1
  double growth = 0.05;         // relocate: share by which their number may grow in a round, >= 0
  double pull = 2e-4;           // split: mean gradient on the screen [loss / half image] from which one is cloned or
                                // split, > 0
  double split_size = 0.01;     // split: largest axis [camera extents] from which it is split, not cloned, > 0; kept
                                // between the next two limits
  double least_split_px = 0.5;  // least such size in the images [px], >= 0: one smaller than a pixel need not be split;
                                // 0: no limit
  double most_split_px = 4.0;   // largest such size [px]: one over several pixels hides detail; infinity: no limit. The
                                // camera extent alone says nothing about sizes in images if cameras hardly move or
                                // cross a building
  double largest_size = 0.5;    // split: removed if an axis is longer [camera extents], > 0; where growth is limited
                                // none is removed for its size
  int reset_interval = 0;       // split: opacities fall to reset_opacity this often [iterations], 0: never
  double reset_opacity = 0.2;   // 0..1, both excluded

  /// Throws InputError naming the field.
  void check() const;
};

DensifyMethod densify_method(const std::string& name);  // "none", "relocate", "split"; InputError else
std::string name_of(DensifyMethod method);

/// The arrays with a row for each Gaussian that training keeps, on the host. Optional arrays are empty.
struct TrainingRows {
  Gaussians gaussians;
  std::vector<float> largest_log_scales;  // [N x 3] or empty
  std::vector<float> anchors;             // [N x 8] or empty
  std::vector<std::int64_t> from;         // [N] row that the optimiser's moments come from, -1: they start at zero

  std::size_t size() const { return gaussians.size(); }
  /// A copy of row i at the end, without moments; its index.
  std::size_t append_copy(std::size_t i);
  /// Moves row i by `shift` [m, its own axes], and its anchor with it.
  void move(std::size_t i, const float shift[3]);
  /// Drops the rows with keep[i] == false.
  void keep(const std::vector<bool>& keep);
};

/// Dead Gaussians (opacity at most dead_opacity) are moved onto live ones drawn by opacity, and new ones are added
/// there while there are fewer than the budget. Opacity and size of those that share a place are set so that together
/// they look like the one before. Source: Kheradmand et al. 2024 (3DGS as MCMC), eq. 9. Differs: copies are placed at
/// random within the Gaussian's own extent in its plane, instead of noise in every step, so that a surface stays where
/// it is; the third axis keeps its thickness.
void relocate(TrainingRows& rows, const DensifyOptions& options, Random& random);

/// Sizes [m] that clone_and_split decides by.
struct DensifySizes {
  double split = 0.0;    // a Gaussian whose largest axis is longer is split, else cloned
  double largest = 0.0;  // and removed beyond this
};

/// camera_extent [m]: largest distance of a camera from the cameras' mean; pixel [m]: width of a pixel at the distance
/// of what is seen, 0: unknown; growth_limited: no Gaussian grows without limit, so that none is too large.
DensifySizes densify_sizes(const DensifyOptions& options, double camera_extent, double pixel, bool growth_limited);

/// pulls [N] and seen [N]: sums of gradients on the screen and numbers of views, as screen_statistics.cl makes them.
/// Source: Kerbl et al. 2023, section 5.2. Differs: with a budget, the Gaussians with the largest mean gradients come
/// first and the rest is left as it is; no limit on size in pixels.
void clone_and_split(TrainingRows& rows, const DensifyOptions& options, const DensifySizes& sizes,
                     const std::vector<float>& pulls, const std::vector<float>& seen, Random& random);

/// Size of N Gaussians of opacity `shared_opacity` in one place, over that of the one of `opacity` they replace.
double relocated_size_ratio(double opacity, double shared_opacity, int n);

}  // namespace odosplat
