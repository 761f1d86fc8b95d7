// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "odosplat/splat/edit/view_weights.hpp"
#include "odosplat/splat/map.hpp"

namespace odosplat {

/// Why a Gaussian is no part of a surface. In this order: a Gaussian has the first that holds.
enum class Floater : unsigned char { none, transparent, huge, isolated, hanging };

/// "almost transparent", "huge", "isolated", "in free space", by the number of the reason; [0]: "kept".
extern const std::array<const char*, 5> floater_words;

/// What counts as floating. "Spacing" is the mean distance of a Gaussian to its six nearest; that of the surface around
/// a Gaussian is the median over its 16 nearest.
struct FloaterOptions {
  float least_opacity = 0.02F;   // transparent: below it, 0..1
  double huge_spacings = 8.0;    // huge: its longest standard deviation is more than this many spacings of the surface
                                 // around it, and it sticks out of the surface
  double apart_spacings = 3.0;   // isolated: in a group that is this many spacings (of the surface around it, at most
                                 // the map's median) away from all others ...
  std::size_t least_group = 10;  // ... and has fewer Gaussians than this, unless they and what surrounds them lie in a
                                 // plane, as the Gaussians of a distant wall do
  double free_spacings = 2.0;    // hanging: it is before the surface by more than this many spacings ...
  double free_share = 0.02;      // ... and this share of its depth ...
  int least_views = 2;           // ... in at least so many views, >= 1 ...
  double views_for_one = 3.0;    // ... and in more than this many for each view in which it lies on the surface

  /// Throws InputError naming the field.
  void check() const;
};

/// The reason of every Gaussian, by the shape and place of all. Uses all threads; bit-identical for any number of
/// threads.
std::vector<Floater> find_floaters(const Gaussians& gaussians, const FloaterOptions& options = {});

/// The same, and then those of the rest that hang in free space (Floater::hanging): before the surface that the views
/// show. The surface is the measured depth; in a view without it, the depth of the map's rest as rendered, which shows
/// only what the map itself lets through: a hanging Gaussian that is opaque counts as surface there. Near the outlines
/// of things the nearest depth within a pixel counts. Deterministic.
std::vector<Floater> find_floaters(const compute::Context& context, const Map& map, const std::vector<EditView>& views,
                                   const FloaterOptions& options = {}, const ViewNotice& notice = {});

/// Number of Gaussians of each kind, by its number.
std::array<std::size_t, 5> count_floaters(const std::vector<Floater>& floaters);

/// The map without them, with a line "edit clean: ..." in its header. InputError if none is left.
Map without_floaters(const Map& map, const std::vector<Floater>& floaters);

}  // namespace odosplat
