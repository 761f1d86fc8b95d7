// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/gltf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "odosplat/splat/format/spz.hpp"
#include "tests/splat/format/made_map.hpp"

namespace odosplat {
namespace {

using Json = nlohmann::json;
using test::fault_of;
using test::little;
using testing::ElementsAre;
using testing::HasSubstr;

const std::vector<std::string> header{"odosplat map, format 1", "blend_order distance", "training_view 0 0 0 0 0 0 1",
                                      "quality_psnr_db 30"};

std::string no_sibling(const std::string& name) { throw InputError(name, "was asked for"); }

ForeignMap parse(const std::string& bytes) { return parse_gltf("m.glb", bytes, no_sibling); }

std::string fault(const std::string& bytes) {
  return fault_of([&] { parse(bytes); });
}

std::string floats(const std::vector<float>& values) {
  std::string bytes;
  for (const float v : values) append_little(bytes, v);
  return bytes;
}

std::string glb(const Json& json, std::string binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  const auto size = static_cast<std::uint32_t>(28 + text.size() + binary.size());
  return "glTF" + little<std::uint32_t>(2) + little(size) + little(static_cast<std::uint32_t>(text.size())) + "JSON" +
         text + little(static_cast<std::uint32_t>(binary.size())) + std::string("BIN\0", 4) + binary;
}

/// One Gaussian at (1, 2, 3), turned by a quarter about x, of sizes 1, 2, 4, opacity 0.75, and its file.
struct OneGaussian {
  std::vector<float> rotation{std::sqrt(0.5F), 0, 0, std::sqrt(0.5F)};  // x y z w
  std::vector<float> scale{1, 2, 4};
  std::vector<float> opacity{0.75F};
  std::vector<float> position{1, 2, 3};
  std::vector<float> color{0.1F, 0.2F, 0.3F};
  Json json{{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}}}},
            {"meshes",
             {{{"primitives",
                {{{"mode", 0},
                  {"attributes",
                   {{"POSITION", 0},
                    {"KHR_gaussian_splatting:ROTATION", 1},
                    {"KHR_gaussian_splatting:SCALE", 2},
                    {"KHR_gaussian_splatting:OPACITY", 3},
                    {"KHR_gaussian_splatting:SH_DEGREE_0_COEF_0", 4}}},
                  {"extensions", {{"KHR_gaussian_splatting", {{"kernel", "ellipse"}}}}}}}}}}}};

  OneGaussian() {
    std::size_t at = 0;
    for (const auto& [type, width] : {std::pair("VEC3", 3), std::pair("VEC4", 4), std::pair("VEC3", 3),
                                      std::pair("SCALAR", 1), std::pair("VEC3", 3)}) {
      json["accessors"].push_back(
          {{"bufferView", json["accessors"].size()}, {"componentType", 5126}, {"count", 1}, {"type", type}});
      json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", at}, {"byteLength", 4 * width}});
      at += 4 * static_cast<std::size_t>(width);
    }
    json["buffers"] = {{{"byteLength", at}}};
  }
  std::string binary() const {
    return floats(position) + floats(rotation) + floats(scale) + floats(opacity) + floats(color);
  }
  std::string file() const { return glb(json, binary()); }
};

TEST(Gltf, IsReadAsTheBytesSay) {
  const ForeignMap map = parse(OneGaussian().file());
  const Gaussians& g = map.gaussians;
  ASSERT_EQ(g.size(), 1U);
  EXPECT_THAT(g.positions, ElementsAre(-1, -2, 3));  // x left and y up become x right and y down
  EXPECT_NEAR(g.rotations[0], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(g.rotations[1], -std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(g.log_scales[2], std::log(4.0), 1e-6);
  EXPECT_NEAR(test::opacity(g, 0), 0.75, 1e-6);
  EXPECT_THAT(g.sh, ElementsAre(0.1F, 0.2F, 0.3F));
  EXPECT_THAT(map.lines, ElementsAre());  // the sorting method is no evidence
}

TEST(Gltf, WhatIsWrittenComesBackAsFloatsAllow) {
  for (int degree = 0; degree <= 3; ++degree) {
    const Gaussians g = test::made_gaussians(degree, 100);
    const ForeignMap back = parse(glb_bytes("m.glb", g, header));
    test::expect_near(back.gaussians, g, {0.0, 1e-6, 1e-7, 0.0, 0.0, 1e-6});
    EXPECT_EQ(back.lines, header);
    EXPECT_EQ(gltf_lines("m.glb", glb_bytes("m.glb", g, header)), header);
  }
  EXPECT_THAT(parse(glb_bytes("m.glb", test::made_gaussians(0, 1), {})).lines, ElementsAre());
}

TEST(Gltf, NodesMoveTheGaussians) {
  OneGaussian one;
  // A quarter turn about z in glTF's axes, twice as large, 10 along x: (1, 2, 3) goes to (10 - 4, 2, 6).
  one.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}, {"scale", {2, 2, 2}}},
                       {{"mesh", 0}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}}};
  const Gaussians g = parse(one.file()).gaussians;
  EXPECT_NEAR(g.positions[0], -6, 1e-5);
  EXPECT_NEAR(g.positions[1], -2, 1e-5);
  EXPECT_NEAR(g.positions[2], 6, 1e-5);
  EXPECT_NEAR(g.log_scales[2], std::log(8.0), 1e-6);
  one.json["nodes"] = {{{"mesh", 0}, {"matrix", {0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 10, 0, 0, 1}}}};
  EXPECT_THAT(parse(one.file()).gaussians.positions, ElementsAre(-6, -2, 6));
  one.json["nodes"][0]["matrix"][0] = 1;
  EXPECT_THAT(fault(one.file()), HasSubstr("nodes[0]: shears the Gaussians"));
  one.json["nodes"] = {{{"mesh", 0}, {"scale", {-1, 1, 1}}}};
  EXPECT_THAT(fault(one.file()), HasSubstr("nodes[0]: mirrors the Gaussians"));
}

TEST(Gltf, LinesOfThePlaceGoWhereANodeMovesTheMap) {
  Json json;
  const std::string file = glb_bytes("m.glb", test::made_gaussians(0, 2), header);
  const std::size_t size = load_little<std::uint32_t>(&file[12]);
  json = Json::parse(file.substr(20, size));
  json["nodes"][0]["translation"] = {0, 0, 1};
  const std::string moved = glb(json, file.substr(28 + size));
  EXPECT_THAT(parse(moved).lines, ElementsAre(header[0], header[1]));
  EXPECT_THAT(gltf_lines("m.glb", moved), ElementsAre(header[0], header[1]));
}

TEST(Gltf, SeveralPrimitivesAreOneMap) {
  OneGaussian one;
  one.json["nodes"].push_back({{"mesh", 0}, {"translation", {0, 0, 1}}});
  one.json["scenes"][0]["nodes"] = {0, 1};
  one.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}});  // points of another kind
  EXPECT_THAT(parse(one.file()).gaussians.positions, ElementsAre(-1, -2, 3, -1, -2, 4));
}

TEST(Gltf, IntegersAreNormalised) {
  OneGaussian one;
  const std::string binary = floats(one.position) + test::bytes_of({127, 0, 0, 0}) + test::bytes_of({2, 3, 4, 0}) +
                             test::bytes_of({51, 0, 0, 0}) + floats(one.color);
  std::size_t at = 0;
  for (const std::size_t view : {0U, 1U, 2U, 3U, 4U}) {
    const std::size_t size = view == 0 || view == 4 ? 12 : 4;
    one.json["bufferViews"][view] = {{"buffer", 0}, {"byteOffset", at}, {"byteLength", size}};
    at += size;
  }
  one.json["accessors"][1].update({{"componentType", 5120}, {"normalized", true}});
  one.json["accessors"][2].update({{"componentType", 5121}});
  one.json["accessors"][3].update({{"componentType", 5121}, {"normalized", true}});
  one.json["buffers"][0]["byteLength"] = at;
  const Gaussians g = parse(glb(one.json, binary)).gaussians;
  EXPECT_THAT(g.rotations, ElementsAre(0, -1, 0, 0));
  EXPECT_NEAR(g.log_scales[1], std::log(3.0), 1e-6);
  EXPECT_NEAR(test::opacity(g, 0), 0.2, 1e-6);
}

TEST(Gltf, SizesBelow0AreLogarithmsOfTheDrafts) {
  OneGaussian one;
  one.scale = {-3, 0.5F, -1};
  EXPECT_THAT(parse(one.file()).gaussians.log_scales, ElementsAre(-3, 0.5F, -1));
}

TEST(Gltf, OpacitiesOfNoneAndAllAndSizesOfNoneStayFinite) {
  OneGaussian one;
  for (const float opacity : {0.0F, 1.0F}) {
    one.opacity = {opacity};
    one.scale = {0, 1, 1};
    const Gaussians g = parse(one.file()).gaussians;
    EXPECT_EQ(g.opacity_logits[0], opacity > 0.0F ? 20.0F : -20.0F);
    EXPECT_EQ(g.log_scales[0], -23.0F);
  }
}

TEST(Gltf, SpzInABufferView) {
  OneGaussian one;
  const Gaussians g = test::made_gaussians(1, 5);
  const std::string spz = spz_bytes("m.spz", g, {});
  one.json["bufferViews"] = {{{"buffer", 0}, {"byteLength", spz.size()}}};
  one.json["buffers"][0]["byteLength"] = spz.size();
  one.json["meshes"][0]["primitives"][0]["extensions"]["KHR_gaussian_splatting"]["extensions"] = {
      {"KHR_gaussian_splatting_compression_spz_2", {{"bufferView", 0}}}};
  const Gaussians back = parse(glb(one.json, spz)).gaussians;
  EXPECT_EQ(back.positions, parse_spz("m.spz", spz).gaussians.positions);
  EXPECT_EQ(back.sh, parse_spz("m.spz", spz).gaussians.sh);
}

TEST(Gltf, BuffersMayBeOtherFilesOrInTheText) {
  OneGaussian one;
  one.json["buffers"][0]["uri"] = "a%20b.bin";
  const auto sibling = [&](const std::string& name) { return name == "a b.bin" ? one.binary() : std::string(); };
  EXPECT_THAT(parse_gltf("m.gltf", one.json.dump(), sibling).gaussians.positions, ElementsAre(-1, -2, 3));
  EXPECT_EQ(fault(one.json.dump()), "a b.bin: was asked for");
  one.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,AACAPwAAAEAAAEBA";
  one.json["buffers"][0]["byteLength"] = 12;
  for (Json& view : one.json["bufferViews"]) view["byteOffset"] = 0;
  one.json["bufferViews"][1]["byteLength"] = 12;
  EXPECT_THAT(fault(one.json.dump()), HasSubstr("accessors[1].count: 1 values reach beyond the buffer view"));
  one.json["buffers"][0]["uri"] = "data:application/octet-stream;base64,A?CAPw";
  EXPECT_THAT(fault(one.json.dump()), HasSubstr("buffers[0].uri: is no base64 data"));
}

TEST(Gltf, FaultsAreNamed) {
  const std::string good = OneGaussian().file();
  for (std::size_t n = 4; n < good.size(); ++n) EXPECT_NE(fault(good.substr(0, n)), "") << n;
  const auto with = [](const auto& change) {
    OneGaussian one;
    change(one.json);
    return fault(one.file());
  };
  EXPECT_THAT(with([](Json& j) { j["accessors"][0]["count"] = 2; }),
              HasSubstr("accessors[0].count: 2 values reach beyond the buffer view"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][0]["count"] = 1e15; }),
              HasSubstr("accessors[0].count: must be a whole"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][0]["count"] = -1; }), HasSubstr("accessors[0].count: must be a whole"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][0]["count"] = std::uint64_t{1} << 62U; }), HasSubstr("reach beyond"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][3]["count"] = 0; }), HasSubstr("OPACITY has 0 values, POSITION has 1"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][1]["type"] = "VEC3"; }), HasSubstr("accessors[1].type: must be VEC4"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][1]["componentType"] = 5125; }),
              HasSubstr("componentType: is not read"));
  EXPECT_THAT(with([](Json& j) { j["accessors"][1]["sparse"] = Json::object(); }),
              HasSubstr("accessors[1]: is sparse"));
  EXPECT_THAT(with([](Json& j) { j["bufferViews"][0]["byteOffset"] = 60; }),
              HasSubstr("bufferViews[0]: reaches beyond"));
  EXPECT_THAT(with([](Json& j) { j["bufferViews"][0]["buffer"] = 3; }), HasSubstr("elements of buffers"));
  EXPECT_THAT(with([](Json& j) { j["bufferViews"][0]["byteStride"] = 4; }), HasSubstr("byteStride"));
  EXPECT_THAT(with([](Json& j) { j["buffers"][0]["byteLength"] = 1 << 30; }), HasSubstr("buffers[0].byteLength"));
  EXPECT_THAT(with([](Json& j) { j["nodes"][0]["mesh"] = "a"; }), HasSubstr("elements of meshes"));
  EXPECT_THAT(with([](Json& j) { j["nodes"][0]["children"] = {0}; }), HasSubstr("nodes contain each other"));
  EXPECT_THAT(with([](Json& j) {
                j["nodes"][0]["rotation"] = {0, 0, 0, 0};
              }),
              HasSubstr("rotation: must be of length 1"));
  EXPECT_THAT(with([](Json& j) { j["nodes"] = Json::array(); }), HasSubstr("0 elements of nodes"));
  EXPECT_THAT(with([](Json& j) { j["meshes"][0]["primitives"][0].erase("extensions"); }),
              HasSubstr("holds no Gaussians"));
  EXPECT_THAT(with([](Json& j) { j["meshes"][0]["primitives"][0]["attributes"].erase("POSITION"); }),
              HasSubstr("has no attribute POSITION"));
  EXPECT_THAT(with([](Json& j) { j["meshes"][0]["extras"]["odosplat_map"] = 1; }),
              HasSubstr("must be a list of lines"));
  std::string other = good;
  other[4] = 1;
  EXPECT_EQ(fault(other), "m.glb: is glTF of version 1, must be 2");
}

TEST(Gltf, ValuesThatCannotBeDrawnAreBroken) {
  OneGaussian one;
  one.position[0] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(fault(one.file()), HasSubstr("Gaussian 0: its position is not finite"));
  one = OneGaussian();
  one.opacity[0] = 1.5F;
  EXPECT_THAT(fault(one.file()), HasSubstr("Gaussian 0: its opacity is not in 0..1"));
  one = OneGaussian();
  one.rotation = {0, 0, 0, 0};
  EXPECT_THAT(fault(one.file()), HasSubstr("Gaussian 0: its rotation has length 0"));
}

// A scene that repeats a mesh in every node grows without bounds.
TEST(Gltf, RepeatedMeshesAreLimited) {
  OneGaussian one;
  for (int i = 0; i < 16; ++i) {
    one.json["nodes"].push_back({{"children", {i == 0 ? 0 : i, i == 0 ? 0 : i, i == 0 ? 0 : i, i == 0 ? 0 : i}}});
  }
  one.json["scenes"][0]["nodes"] = {16};
  EXPECT_THAT(fault(one.file()), testing::AnyOf(HasSubstr("too many nodes"), HasSubstr("too often")));
}

}  // namespace
}  // namespace odosplat
