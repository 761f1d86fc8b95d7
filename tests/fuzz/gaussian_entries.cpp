// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Separate from entries.cpp, because it needs the library splat.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "odosplat/core/error.hpp"
#include "odosplat/splat/format/gltf.hpp"
#include "odosplat/splat/format/spz.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/splat_file.hpp"
#include "tests/fuzz/entries.hpp"

namespace odosplat::fuzz {
namespace {

void demand(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "contract broken: %s\n", what);
  std::abort();
}

void read_or_refuse(const char* name, const std::string& bytes) {
  Gaussians g;
  try {
    g = parse_map(name, bytes).gaussians;
  } catch (const InputError& e) {
    demand(std::string(e.what()).find('\n') == std::string::npos, "an error has one line");
    return;
  }
  g.check();
  demand(!g.empty(), "a map has Gaussians");
  for (const auto* part : {&g.positions, &g.log_scales, &g.rotations, &g.opacity_logits, &g.sh}) {
    for (const float value : *part) demand(std::isfinite(value), "values are finite");
  }
  demand(splat_bytes(g).size() == 32 * g.size(), "a .splat holds every Gaussian");
  demand(parse_splat("again", splat_bytes(g)).size() == g.size(), "what is written can be read");
  demand(parse_map("again.glb", glb_bytes("again.glb", g, {})).gaussians.size() == g.size(), "so can a GLB");
  for (const float position : g.positions) {
    if (std::abs(position) > 4e6F) return;  // too far for SPZ
  }
  demand(parse_map("again.spz", spz_bytes("again.spz", g, {})).gaussians.size() == g.size(), "and an SPZ");
}

}  // namespace

void gaussians(const std::string& bytes) {
  read_or_refuse("fuzz.splat", bytes);
  // Other formats are recognised by their content; glTF and SOG as text by their names too.
  for (const char* name : {"fuzz.ply", "fuzz.gltf", "meta.json"}) read_or_refuse(name, bytes);
}

}  // namespace odosplat::fuzz
