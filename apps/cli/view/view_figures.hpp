// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <cstddef>
#include <string>

#include "apps/input/map_views.hpp"
#include "viewer/figures/association_figure.hpp"
#include "viewer/figures/compare_figure.hpp"

/// Figures of a sequence's frames, as `odosplat view` and the benchmark's reports show them.
namespace odosplat::apps {

/// True pose of a frame; InputError naming `flag` if there is no such frame or it has no pose.
SE3 pose_of_frame(const Sequence& sequence, std::size_t frame, const std::string& flag = "--frame");

/// Views of the two depth methods that the paper compares, opened once for any number of frames.
struct ComparedViews {
  OpenedView interpolation;
  OpenedView gaussian;
};
/// InputError for a missing map or cloud.
ComparedViews open_compared_views(const Common& common, const MapFlags& flags);

/// Image, interpolated depth, rendered depth and true depth (if there is any) of a frame at its true pose.
CompareExample compare_example(ComparedViews& views, const Sequence& sequence, std::size_t frame,
                               const std::string& name);

/// The cloud, interpolated depth, rendered depth and image of a frame at its true pose.
AssociationFigure association_figure(ComparedViews& views, const Sequence& sequence, std::size_t frame,
                                     const MapFlags& flags);

}  // namespace odosplat::apps
