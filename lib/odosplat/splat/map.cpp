// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/map.hpp"

#include <algorithm>
#include <utility>

#include "odosplat/splat/blend_order.hpp"
#include "odosplat/splat/map_header.hpp"
#include "odosplat/splat/map_places.hpp"

namespace odosplat {

MapHeader MapHeader::from_notes(std::vector<std::string> notes) {
  MapHeader header;
  header.rasterizer.order = blend_order_from_lines(notes);
  if (const auto value = map_header_number(notes, "dilation")) header.rasterizer.dilation = static_cast<float>(*value);
  if (const auto value = map_header_number(notes, "compensated")) header.rasterizer.compensated = *value != 0.0;
  if (std::any_of(notes.begin(), notes.end(), [](const std::string& note) { return note.starts_with("sigma_"); })) {
    header.sigma = SigmaModel::from_lines(notes);
  }
  header.places = places_from_lines(notes);
  header.quality = MapQuality::from_lines(notes);
  header.notes = std::move(notes);
  return header;
}

}  // namespace odosplat
