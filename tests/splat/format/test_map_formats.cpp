// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Maps in every format through read_map and write_map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "odosplat/io/atomic_file.hpp"
#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/splat/format/gltf.hpp"
#include "odosplat/splat/format/map_format.hpp"
#include "odosplat/splat/format/spz.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/map_places.hpp"
#include "tests/splat/format/made_map.hpp"
#include "tests/splat/format/zip_bytes.hpp"
#include "tests/splat/scratch.hpp"

namespace odosplat {
namespace {

using test::fault_of;
using testing::HasSubstr;

const std::vector<std::string> notes{"blend_order distance", "dilation 0.2",       "compensated 1",
                                     "sigma_spread 0.7",     "sigma_slope_px 0.4", "training_view 1 2 3 0 0 0 1",
                                     "iterations 4000",      "a line of its own"};

TEST(MapFormats, TheHeaderSurvivesWhereTheFormatHasAPlaceForIt) {
  const test::Scratch scratch;
  const Gaussians g = test::made_gaussians(2, 50);
  for (const char* name : {"m.ply", "m.spz", "m.SPZ", "m.glb"}) {
    const std::string path = scratch / name;
    write_map(path, g, notes);
    EXPECT_TRUE(is_map_file(path)) << name;
    for (const MapHeader& header : {read_map(path).header, read_map_header(path)}) {
      EXPECT_EQ(header.notes, notes) << name;
      EXPECT_EQ(header.rasterizer.order, BlendOrder::distance);
      EXPECT_EQ(header.rasterizer.dilation, 0.2F);
      EXPECT_TRUE(header.rasterizer.compensated);
      ASSERT_TRUE(header.sigma.has_value());
      EXPECT_EQ(header.sigma->spread, 0.7F);
      ASSERT_EQ(header.places.size(), 1U);
      EXPECT_EQ(header.places[0].translation(), Eigen::Vector3d(1, 2, 3));
    }
    EXPECT_EQ(read_map(path).gaussians.size(), 50U);
    EXPECT_EQ(map_file_size(path), std::filesystem::file_size(path));
  }
}

// What another program wrote says nothing of this: the same defaults as for a PLY of another program.
TEST(MapFormats, AMapOfAnotherProgramGetsTheDefaults) {
  const test::Scratch scratch;
  write_file_atomically(scratch / "m.spz", spz_bytes("m.spz", test::made_gaussians(1, 5), {}));
  write_file_atomically(scratch / "m.glb", glb_bytes("m.glb", test::made_gaussians(1, 5), {}));
  for (const char* name : {"m.spz", "m.glb"}) {
    const MapHeader header = read_map(scratch / name).header;
    EXPECT_TRUE(header.notes.empty());
    EXPECT_EQ(header.rasterizer.order, BlendOrder::depth);
    EXPECT_FALSE(header.sigma.has_value());
  }
  // A field of our header that is broken is named, in every format.
  write_file_atomically(scratch / "m.spz", spz_bytes("m.spz", test::made_gaussians(1, 5), {"sigma_spread many"}));
  EXPECT_THAT(fault_of([&] { read_map(scratch / "m.spz"); }), HasSubstr("m.spz: header: sigma_spread: must be"));
}

TEST(MapFormats, TheContentDecidesNotTheName) {
  const test::Scratch scratch;
  const Gaussians g = test::made_gaussians(1, 5);
  write_map(scratch / "a.spz", g);
  write_map(scratch / "a.glb", g);
  write_map(scratch / "a.ply", g);
  for (const char* from : {"a.spz", "a.glb", "a.ply"}) {
    for (const char* to : {"b.spz", "b.glb", "b.ply", "b.splat", "b.sog", "b.dat"}) {
      std::filesystem::copy_file(scratch / from, scratch / to, std::filesystem::copy_options::overwrite_existing);
      testing::internal::CaptureStderr();
      EXPECT_EQ(read_map(scratch / to).gaussians.sh_degree, 1) << from << " " << to;
      const std::string said = testing::internal::GetCapturedStderr();
      const auto by_name = format_of_name(to);
      if (by_name && by_name != format_of_name(from)) {
        EXPECT_THAT(said, HasSubstr(std::string("named as ") + format_name(*by_name) + ", but holds " +
                                    format_name(*format_of_name(from))));
      } else {
        EXPECT_EQ(said, "");
      }
    }
  }
}

TEST(MapFormats, FormatsThatTheContentIsNotAreNamed) {
  const test::Scratch scratch;
  for (const auto& [name, fault] : {std::pair("m.spz", "is no SPZ, as its name says"), std::pair("m.glb", "is no glTF"),
                                    std::pair("m.gltf", "is no glTF"), std::pair("m.sog", "is no SOG")}) {
    write_file_atomically(scratch / name, "no map");
    EXPECT_THAT(fault_of([&] { read_map(scratch / name); }), HasSubstr(fault));
    EXPECT_THAT(fault_of([&] { read_map_header(scratch / name); }), HasSubstr(fault));
    EXPECT_TRUE(is_map_file(scratch / name));  // so that the fault above is shown, not one of a cloud
  }
  write_file_atomically(scratch / "m.ksplat", "no map");
  EXPECT_THAT(fault_of([&] { read_map(scratch / "m.ksplat"); }), HasSubstr("is a map in KSPLAT, which is not read"));
  write_file_atomically(scratch / "transforms.json", "{\"frames\": []}");
  EXPECT_FALSE(is_map_file(scratch / "transforms.json"));
  EXPECT_FALSE(is_map_file(scratch / "none.spz") && std::filesystem::exists(scratch / "none.spz"));
  write_file_atomically(scratch / "c.spz", test::gzip("no map"));
  EXPECT_THAT(fault_of([&] { read_point_cloud(scratch / "c.spz"); }),
              HasSubstr("`odosplat convert` makes a PLY of it"));
}

TEST(MapFormats, WhatIsNotWrittenIsRefused) {
  const test::Scratch scratch;
  const Gaussians g = test::made_gaussians(0, 2);
  EXPECT_THAT(fault_of([&] { write_map(scratch / "m.gltf", g); }), HasSubstr("is written as one binary file, .glb"));
  EXPECT_THAT(fault_of([&] { write_map(scratch / "m.sog", g); }), HasSubstr("SOG is read, but not written"));
  EXPECT_TRUE(std::filesystem::is_empty(scratch / ""));
}

TEST(MapFormats, LossesAreSaidInOneLine) {
  const test::Scratch scratch;
  const auto said = [&](const char* name, const std::vector<std::string>& lines) {
    testing::internal::CaptureStderr();
    write_map(scratch / name, test::made_gaussians(1, 2), lines);
    return testing::internal::GetCapturedStderr();
  };
  const std::string splat = said("m.splat", notes);
  EXPECT_THAT(splat, HasSubstr("sorted by distance"));
  EXPECT_THAT(splat, HasSubstr("harmonics of degree 1 to 1"));
  EXPECT_THAT(splat, HasSubstr("the header (model of sigma, places, quality, settings)"));
  EXPECT_EQ(std::count(splat.begin(), splat.end(), '\n'), 1);
  EXPECT_EQ(said("m.spz", notes), "");
  EXPECT_EQ(said("m.glb", notes), "");
  EXPECT_THAT(said("m.glb", {}), HasSubstr("sorted by depth"));
}

TEST(MapFormats, FilesBesideAMapAreOfItsFolderOnly) {
  const test::Scratch scratch;
  write_file_atomically(scratch / "secret", std::string(64, 'x'));
  std::filesystem::create_directories(scratch / "d");
  for (const std::string& uri : {std::string("../secret"), scratch / "secret", std::string("a/../../secret")}) {
    write_file_atomically(
        scratch / "d/m.gltf",
        R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 12, "uri": ")" + uri +
            R"("}], "bufferViews": [{"buffer": 0, "byteLength": 12}], "accessors": [{"bufferView": 0, "count": 1,)" +
            R"("componentType": 5126, "type": "VEC3"}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0},)" +
            R"("extensions": {"KHR_gaussian_splatting": {}}}]}]})");
    EXPECT_THAT(fault_of([&] { read_map(scratch / "d/m.gltf"); }),
                HasSubstr("must be a file in the folder of the map"));
  }
}

}  // namespace
}  // namespace odosplat
