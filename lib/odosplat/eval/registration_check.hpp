// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "odosplat/camera/camera.hpp"
#include "odosplat/core/image.hpp"

namespace odosplat {

/// Colour images and depth images that are declared to be from one camera.
struct RegistrationInput {
  Camera camera;
  std::size_t images = 0;
  std::function<GrayImage(std::size_t)> gray;    // of the camera's size
  std::function<DepthImage(std::size_t)> depth;  // of the same size [m], 0 = none
};

struct RegistrationOptions {
  int images = 24;                // number that is used, spread evenly
  double max_scale_change = 0.2;  // range of the search for the scale, in both directions
  double max_shift = 0.04;        // range of the search for the shift along either axis, as a share of the image width
  double tolerance = 0.008;       // share of the image width: a smaller misfit at the corners counts as registered
  double clear = 0.02;            // share of the image width: a larger misfit counts as not registered
  double sure = 4.0;              // standard deviations that a misfit must exceed to count as not registered

  void check() const;
};

/// The mapping from the edges of depth to those of the colour images: u_color = center + scale * (u_depth - center) +
/// shift.
struct RegistrationReport {
  std::optional<bool> registered;  // none: not decidable from the images
  double scale = 1.0;              // focal length of colour over that of depth
  double scale_sigma = 0.0;
  Eigen::Vector2d shift_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d shift_sigma_px = Eigen::Vector2d::Zero();
  double contrast = 0.0;           // colour gradient at the mapped edges divided by that around them; 1: no contrast
  double declared_contrast = 0.0;  // the same at the declared positions of the edges
  std::size_t edges = 0;
  std::string text;  // one sentence
};

/// Determines whether depth is registered to the colour camera's pixels: at an occluding edge depth is discontinuous,
/// and usually colour too. The colour gradient across the edges of depth, relative to the mean gradient around, is
/// computed for every scale about the principal point and every shift in range, and the best placement is taken; sigmas
/// are from a jackknife over groups of images. Depth from a camera at another position or with another focal length has
/// its edges elsewhere. Edges are taken on the side of the nearer surface, also across holes of up to 8 pixels (a depth
/// sensor's shadow). The result is
///   - not registered if the best placement differs from the declared one by more than `clear` at the image's corner
///     and by more than `sure` sigmas, and the edges are not found half as clearly where they are declared (few edges of
///     one object can be found beside their place along a pattern);
///   - registered if it differs by less than the tolerance;
///   - undecided in between (the text then gives the apparent misfit, such as that of a slightly displaced or rotated
///     camera), with fewer than 2000 edges, or if the gradient at the edges is not at least 15 % above its
///     surroundings.
/// Images wider than 400 pixels are halved.
///
/// Throws InputError if the images are not of the camera's size. Deterministic.
RegistrationReport check_registration(const RegistrationInput& input, const RegistrationOptions& options = {});

}  // namespace odosplat
