// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#pragma once

#include <string>
#include <vector>

namespace odosplat {

/// The key by which Gaussians are sorted before they are blended; it decides which of two that overlap hides the other.
/// Colours are trained for one order and look speckled in another.
enum class BlendOrder {
  depth,    // of the centre along the optical axis (Kerbl et al. 2023): maps of other programs are made for it
  distance  // of the centre from the camera: does not change when the camera turns in place, where a change of the
            // order by depth would be visible in the image
};

/// The order named "depth" or "distance"; InputError for other words.
BlendOrder blend_order(const std::string& word);

/// "blend_order depth" or "blend_order distance": a line of a map's header.
std::string blend_order_line(BlendOrder order);
/// Other lines are ignored; depth if none names an order. InputError for a blend_order that is neither.
BlendOrder blend_order_from_lines(const std::vector<std::string>& lines);

}  // namespace odosplat
