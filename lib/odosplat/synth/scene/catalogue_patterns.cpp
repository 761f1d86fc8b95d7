// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/patterns.hpp"
#include "odosplat/synth/scene/catalogue.hpp"

namespace odosplat {

std::vector<Eigen::Vector3f> Parameters::triples(const std::string& name) const {
  const std::vector<float>& values = list(name);
  std::vector<Eigen::Vector3f> points;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3) points.emplace_back(values[i], values[i + 1], values[i + 2]);
  return points;
}

const std::vector<ParameterRow>& material_parameters() {
  static const std::vector<ParameterRow> rows{
      {"size", {1.0F, 1.0F}, false, 0.01F, 100.0F},  // [m] size of a tile of the texture
      {"pixels", {256.0F, 256.0F}, false, 1.0F, 4096.0F},
      {"tint", {1.0F, 1.0F, 1.0F}, false, 0.0F, 4.0F},
      {"gloss", {0.0F}, false, 0.0F, 1.0F},
      {"emission", {0.0F}},
      {"shadow", {1.0F}, false, 0.0F, 1.0F},   // 0: light passes through
      {"count", {1.0F}, false, 1.0F, 100.0F},  // number of variants, picked at random where a piece uses several
      {"tints", {}, false, 0.0F, 4.0F}};       // of the variants, picked at random
  return rows;
}

const std::vector<PatternRow>& material_patterns() {
  using P = const Parameters&;
  const std::vector<float> color{0.5F, 0.5F, 0.5F};
  const ParameterRow contrast{"contrast", {0.02F}, false, 0.0F, 1.0F};
  const ParameterRow needed_color{"color", color, true, 0.0F, 1.0F};
  const ParameterRow dark{"dark", color, true, 0.0F, 1.0F};
  const ParameterRow bright{"bright", color, true, 0.0F, 1.0F};
  static const std::vector<PatternRow> rows{
      {"plain", {}, false, {}},
      {"plaster",
       {needed_color, contrast},
       false,
       [](P p, int w, int, std::uint32_t s) { return plaster_pattern(w, p.triple("color"), p.number("contrast"), s); }},
      {"wood",
       {dark, bright},
       false,
       [](P p, int w, int h, std::uint32_t s) { return wood_pattern(w, h, p.triple("dark"), p.triple("bright"), s); }},
      {"planks",
       {dark, bright, {"planks", {14.0F}, false, 1.0F, 200.0F}},
       false,
       [](P p, int w, int, std::uint32_t s) {
         return plank_pattern(w, p.integer("planks"), p.triple("dark"), p.triple("bright"), s);
       }},
      {"brick",
       {{"columns", {4.0F}, false, 1.0F, 100.0F}, {"rows", {14.0F}, false, 2.0F, 100.0F}},
       false,
       [](P p, int w, int h, std::uint32_t s) {
         return brick_pattern(w, h, p.integer("columns"), p.integer("rows"), s);
       }},
      {"cloth",
       {needed_color, {"stripe", {0.0F, 0.0F, 0.0F}, false, 0.0F, 1.0F}, {"stripes", {0.0F}, false, 0.0F, 100.0F}},
       false,
       [](P p, int w, int, std::uint32_t s) {
         return cloth_pattern(w, p.triple("color"), p.triple("stripe"), p.integer("stripes"), s);
       }},
      {"carpet", {}, true, [](P, int w, int h, std::uint32_t s) { return carpet_pattern(w, h, s); }},
      {"carpet_tiles",
       {needed_color, contrast, {"tiles", {4.0F}, false, 1.0F, 64.0F}},
       false,
       [](P p, int w, int, std::uint32_t s) {
         return carpet_tile_pattern(w, p.integer("tiles"), p.triple("color"), p.number("contrast"), s);
       }},
      {"ceiling_tiles",
       {needed_color, {"rail", {0.8F, 0.8F, 0.8F}, false, 0.0F, 1.0F}, {"tiles", {4.0F}, false, 1.0F, 64.0F}},
       false,
       [](P p, int w, int, std::uint32_t s) {
         return ceiling_tile_pattern(w, p.integer("tiles"), p.triple("color"), p.triple("rail"), s);
       }},
      {"picture",
       {{"kind", {0.0F}, false, 0.0F, 2.0F}},
       true,
       [](P p, int w, int h, std::uint32_t s) { return picture_pattern(w, h, p.integer("kind"), s); }},
      {"book", {}, true, [](P, int w, int h, std::uint32_t s) { return book_pattern(w, h, s); }},
      {"keyboard",
       {{"body", color, true, 0.0F, 1.0F}, {"keys", color, true, 0.0F, 1.0F}},
       true,
       [](P p, int w, int h, std::uint32_t) { return keyboard_pattern(w, h, p.triple("body"), p.triple("keys")); }},
      {"screen", {}, true, [](P, int w, int h, std::uint32_t s) { return screen_pattern(w, h, s); }},
      {"document", {}, true, [](P, int w, int h, std::uint32_t s) { return document_pattern(w, h, s); }},
      {"whiteboard", {}, true, [](P, int w, int h, std::uint32_t s) { return whiteboard_pattern(w, h, s); }}};
  return rows;
}

}  // namespace odosplat
