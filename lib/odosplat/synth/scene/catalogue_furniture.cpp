// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/synth/content/furniture.hpp"
#include "odosplat/synth/content/furniture_office.hpp"
#include "odosplat/synth/scene/catalogue.hpp"

namespace odosplat {
namespace {

using Builder = SceneBuilder;
using Parts = FurnitureParts;

ParameterRow length(const char* name, float metres) { return {name, {metres}, false, 0.001F, 100.0F}; }
ParameterRow size3(float x, float y, float z) { return {"size", {x, y, z}, false, 0.001F, 100.0F}; }
ParameterRow needed_size3() { return {"size", {1.0F, 1.0F, 1.0F}, true, 0.001F, 100.0F}; }
ParameterRow number(const char* name, float value, float low, float high) { return {name, {value}, false, low, high}; }
ParameterRow radiance(float r, float g, float b) { return {"radiance", {r, g, b}, false, 0.0F, 10000.0F}; }

std::vector<FurnitureRow> plain_bodies() {
  return {
      // Origin: the middle of its lower side.
      {"box",
       {needed_size3()},
       {"all"},
       [](Builder& b, const Parts& p, Random&) {
         const Eigen::Vector3f half = 0.5F * p.parameters.triple("size");
         b.add_box({-half.x(), -half.y(), 0.0F}, {half.x(), half.y(), 2.0F * half.z()}, p.material("all"));
       }},
      {"cylinder",
       {length("radius", 0.05F), length("radius_top", 0.05F), length("height", 1.0F)},
       {"all"},
       [](Builder& b, const Parts& p, Random&) {
         b.add_cylinder({0.0F, 0.0F, 0.0F}, {0.0F, 0.0F, p.parameters.number("height")}, p.parameters.number("radius"),
                        p.parameters.number("radius_top"), p.material("all"), 24, true);
       }},
      // A bar along x. Origin: its middle.
      {"rod",
       {length("radius", 0.014F), length("length", 1.0F)},
       {"all"},
       [](Builder& b, const Parts& p, Random&) {
         const float half = 0.5F * p.parameters.number("length");
         const float radius = p.parameters.number("radius");
         b.add_cylinder({-half, 0.0F, 0.0F}, {half, 0.0F, 0.0F}, radius, radius, p.material("all"), 10, true);
       }},
      {"cable",
       {length("radius", 0.004F), {"points", {}, true, -100.0F, 100.0F}},
       {"all"},
       [](Builder& b, const Parts& p, Random&) {
         add_cable(b, p.parameters.triples("points"), p.parameters.number("radius"), p.material("all"));
       }},
      {"carpet",
       {needed_size3()},
       {"top", "side"},
       [](Builder& b, const Parts& p, Random&) {
         const Eigen::Vector3f s = p.parameters.triple("size");
         const float w = 0.5F * s.x();
         const float d = 0.5F * s.y();
         const int side = p.material("side");
         b.add_box({-w, -d, 0.0F}, {w, d, s.z()}, {side, side, side, side, -1, p.material("top")});
       }},
  };
}

std::vector<FurnitureRow> home_things() {
  return {
      {"table",
       {needed_size3(), length("thickness", 0.03F), length("leg", 0.05F)},
       {"top", "legs"},
       [](Builder& b, const Parts& p, Random&) {
         add_table(b, p.parameters.triple("size"), p.parameters.number("thickness"), p.parameters.number("leg"),
                   p.material("top"), p.material("legs"));
       }},
      {"chair",
       {},
       {"wood", "seat"},
       [](Builder& b, const Parts& p, Random&) { add_chair(b, p.material("wood"), p.material("seat")); }},
      {"sofa",
       {length("width", 2.0F)},
       {"cloth", "pillow_a", "pillow_b"},
       [](Builder& b, const Parts& p, Random&) {
         add_sofa(b, p.parameters.number("width"), p.material("cloth"), p.material("pillow_a"), p.material("pillow_b"));
       }},
      {"bookshelf",
       {needed_size3(), number("boards", 6.0F, 1.0F, 20.0F), number("doors", 0.0F, 0.0F, 20.0F)},
       {"wood", "books", "paper"},
       [](Builder& b, const Parts& p, Random& random) {
         add_bookshelf(b, p.parameters.triple("size"), p.parameters.integer("boards"), p.parameters.integer("doors"),
                       p.material("wood"), p.materials.at("books"), p.material("paper"), random);
       }},
      {"sideboard",
       {needed_size3()},
       {"wood", "front", "knobs"},
       [](Builder& b, const Parts& p, Random&) {
         add_sideboard(b, p.parameters.triple("size"), p.material("wood"), p.material("front"), p.material("knobs"));
       }},
      {"picture",
       {length("width", 0.5F), length("height", 0.5F), length("rim", 0.025F)},
       {"picture", "frame"},
       [](Builder& b, const Parts& p, Random&) {
         add_picture(b, p.parameters.number("width"), p.parameters.number("height"), p.parameters.number("rim"),
                     p.material("picture"), p.material("frame"));
       }},
      {"plant",
       {length("height", 1.0F), number("leaves", 14.0F, 1.0F, 200.0F)},
       {"pot", "leaf", "earth"},
       [](Builder& b, const Parts& p, Random& random) {
         add_plant(b, p.parameters.number("height"), p.parameters.integer("leaves"), p.material("pot"),
                   p.material("leaf"), p.material("earth"), random);
       }},
      {"floor_lamp",
       {radiance(105.0F, 84.0F, 56.0F)},
       {"metal", "shade"},
       [](Builder& b, const Parts& p, Random&) {
         add_floor_lamp(b, p.material("metal"), p.material("shade"), p.parameters.triple("radiance"));
       }},
      // Origin: the point from which it hangs.
      {"pendant",
       {length("drop", 1.0F), length("radius", 0.22F)},
       {"shade", "cord"},
       [](Builder& b, const Parts& p, Random&) {
         const float drop = p.parameters.number("drop");
         b.add_cylinder({0.0F, 0.0F, 0.22F - drop}, {0.0F, 0.0F, 0.0F}, 0.004F, 0.004F, p.material("cord"), 8, false);
         b.add_cylinder({0.0F, 0.0F, -drop}, {0.0F, 0.0F, 0.22F - drop}, p.parameters.number("radius"), 0.05F,
                        p.material("shade"), 32, false);
       }},
      {"curtain",
       {length("width", 0.34F), length("height", 2.34F), number("folds", 4.0F, 1.0F, 50.0F)},
       {"cloth"},
       [](Builder& b, const Parts& p, Random&) {
         add_curtain(b, p.parameters.number("width"), p.parameters.number("height"), p.parameters.integer("folds"),
                     p.material("cloth"));
       }},
      {"radiator",
       {length("width", 1.1F)},
       {"metal"},
       [](Builder& b, const Parts& p, Random&) { add_radiator(b, p.parameters.number("width"), p.material("metal")); }},
      {"tableware",
       {},
       {"books", "paper", "bowl", "mug"},
       [](Builder& b, const Parts& p, Random& random) {
         add_tableware(b, p.materials.at("books"), p.material("paper"), p.material("bowl"), p.material("mug"), random);
       }},
      {"television",
       {length("width", 0.96F)},
       {"screen", "body"},
       [](Builder& b, const Parts& p, Random&) {
         add_television(b, p.parameters.number("width"), p.material("screen"), p.material("body"));
       }},
      {"flowers",
       {},
       {"vase", "stalk", "bloom_a", "bloom_b"},
       [](Builder& b, const Parts& p, Random& random) {
         add_flowers(b, p.material("vase"), p.material("stalk"), p.material("bloom_a"), p.material("bloom_b"), random);
       }},
      {"clock",
       {length("radius", 0.16F)},
       {"face", "hands"},
       [](Builder& b, const Parts& p, Random&) {
         add_clock(b, p.parameters.number("radius"), p.material("face"), p.material("hands"));
       }},
      {"door",
       {length("width", 0.86F), length("height", 2.0F)},
       {"leaf", "frame", "handle"},
       [](Builder& b, const Parts& p, Random&) {
         add_door(b, p.parameters.number("width"), p.parameters.number("height"), p.material("leaf"),
                  p.material("frame"), p.material("handle"));
       }},
  };
}

std::vector<FurnitureRow> office_things() {
  return {
      {"desk",
       {size3(1.6F, 0.8F, 0.73F)},
       {"top", "frame"},
       [](Builder& b, const Parts& p, Random&) {
         add_desk(b, p.parameters.triple("size"), p.material("top"), p.material("frame"));
       }},
      {"office_chair",
       {},
       {"cloth", "plastic", "metal"},
       [](Builder& b, const Parts& p, Random&) {
         add_office_chair(b, p.material("cloth"), p.material("plastic"), p.material("metal"));
       }},
      {"monitor",
       {length("width", 0.53F)},
       {"screen", "plastic"},
       [](Builder& b, const Parts& p, Random&) {
         add_monitor(b, p.parameters.number("width"), p.material("screen"), p.material("plastic"));
       }},
      {"keyboard",
       {},
       {"keys", "plastic"},
       [](Builder& b, const Parts& p, Random&) { add_keyboard(b, p.material("keys"), p.material("plastic")); }},
      {"desk_lamp",
       {length("height", 0.4F), radiance(60.0F, 48.0F, 32.0F)},
       {"metal", "shade"},
       [](Builder& b, const Parts& p, Random&) {
         add_desk_lamp(b, p.parameters.number("height"), p.material("metal"), p.material("shade"),
                       p.parameters.triple("radiance"));
       }},
      {"drawers",
       {size3(0.42F, 0.6F, 0.6F), number("drawers", 3.0F, 1.0F, 20.0F)},
       {"body", "front", "handle"},
       [](Builder& b, const Parts& p, Random&) {
         add_drawers(b, p.parameters.triple("size"), p.parameters.integer("drawers"), p.material("body"),
                     p.material("front"), p.material("handle"));
       }},
      {"whiteboard",
       {length("width", 1.8F), length("height", 1.1F)},
       {"board", "frame", "pens"},
       [](Builder& b, const Parts& p, Random&) {
         add_whiteboard(b, p.parameters.number("width"), p.parameters.number("height"), p.material("board"),
                        p.material("frame"), p.material("pens"));
       }},
      {"partition",
       {length("width", 1.6F), length("height", 1.3F)},
       {"cloth", "frame"},
       [](Builder& b, const Parts& p, Random&) {
         add_partition(b, p.parameters.number("width"), p.parameters.number("height"), p.material("cloth"),
                       p.material("frame"));
       }},
      // Origin: on the ceiling.
      {"ceiling_light",
       {{"size", {1.2F, 0.6F}, false, 0.01F, 10.0F}, radiance(6.0F, 6.0F, 5.6F)},
       {"panel", "frame"},
       [](Builder& b, const Parts& p, Random&) {
         add_ceiling_light(b, p.parameters.pair("size"), p.material("panel"), p.material("frame"),
                           p.parameters.triple("radiance"));
       }},
      {"blind",
       {length("width", 1.4F), length("height", 1.3F), number("tilt", 20.0F, -90.0F, 90.0F)},
       {"slat", "cord"},
       [](Builder& b, const Parts& p, Random&) {
         add_blind(b, p.parameters.number("width"), p.parameters.number("height"), p.parameters.number("tilt"),
                   p.material("slat"), p.material("cord"));
       }},
      {"bin",
       {},
       {"body", "paper"},
       [](Builder& b, const Parts& p, Random&) { add_bin(b, p.material("body"), p.material("paper")); }},
      {"papers",
       {number("sheets", 3.0F, 1.0F, 50.0F)},
       {"pages"},
       [](Builder& b, const Parts& p, Random& random) {
         add_papers(b, p.parameters.integer("sheets"), p.materials.at("pages"), random);
       }},
  };
}

}  // namespace

const std::vector<FurnitureRow>& furniture_kinds() {
  static const std::vector<FurnitureRow> rows = [] {
    std::vector<FurnitureRow> all;
    for (const std::vector<FurnitureRow>& part : {plain_bodies(), home_things(), office_things()}) {
      all.insert(all.end(), part.begin(), part.end());
    }
    return all;
  }();
  return rows;
}

}  // namespace odosplat
