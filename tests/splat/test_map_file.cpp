// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "odosplat/core/error.hpp"
#include "odosplat/core/random.hpp"
#include "odosplat/splat/blend_order.hpp"
#include "odosplat/splat/gaussian_view.hpp"
#include "odosplat/splat/map_file.hpp"
#include "odosplat/splat/map_places.hpp"
#include "odosplat/splat/train/trainer_options.hpp"

namespace odosplat {
namespace {

using testing::HasSubstr;

class MapFile : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return folder_ + "/" + name; }

  /// Message of the InputError from reading `name`; empty if there is none.
  std::string fault(const std::string& name) const {
    try {
      read_map(path(name));
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  void write_text(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
  std::string read_text(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::string folder_ =
      (std::filesystem::temp_directory_path() / ("odosplat_map_" + std::to_string(getpid()))).string();
};

Gaussians random_gaussians(std::size_t n, int degree) {
  Random random(3);
  Gaussians g;
  g.sh_degree = degree;
  g.resize(n);
  for (auto* part : {&g.positions, &g.log_scales, &g.rotations, &g.opacity_logits, &g.sh})
    for (float& value : *part) value = static_cast<float>(random.normal());
  return g;
}

TEST_F(MapFile, ReadsBackTheSameBitsForEveryDegree) {
  for (int degree = 0; degree <= 3; ++degree) {
    const Gaussians g = random_gaussians(17, degree);
    write_map(path("map.ply"), g);
    const Gaussians back = read_map(path("map.ply")).gaussians;
    EXPECT_EQ(back.sh_degree, degree);
    EXPECT_EQ(back.positions, g.positions);
    EXPECT_EQ(back.log_scales, g.log_scales);
    EXPECT_EQ(back.rotations, g.rotations);
    EXPECT_EQ(back.opacity_logits, g.opacity_logits);
    EXPECT_EQ(back.sh, g.sh);
  }
}

TEST_F(MapFile, RemembersWhereItWasSeenFrom) {
  std::vector<SE3> views;
  for (int k = 0; k < 30; ++k) views.emplace_back(so3_exp({0.0, 0.1 * k, 0.02}), Eigen::Vector3d(0.01 * k, -1.5, 2.0));
  std::vector<std::string> notes = place_lines(views);
  notes.emplace_back("seed 42");
  write_map(path("map.ply"), random_gaussians(3, 0), notes);
  const std::vector<SE3> back = read_map_header(path("map.ply")).places;
  ASSERT_EQ(back.size(), views.size());
  for (std::size_t k = 0; k < views.size(); ++k) {
    EXPECT_LT((back[k].inverse() * views[k]).translation().norm(), 1e-4);
    EXPECT_LT((back[k].inverse() * views[k]).angle(), 1e-5);
  }
  EXPECT_EQ(read_map(path("map.ply")).gaussians.size(), 3U);
  write_map(path("plain.ply"), random_gaussians(3, 0));
  EXPECT_TRUE(read_map_header(path("plain.ply")).places.empty());
  EXPECT_THROW(read_map_header(path("missing.ply")), InputError);
}

TEST_F(MapFile, BrokenViewsAreNamed) {
  for (const char* note : {"training_view 1 2 3", "training_view 0 0 nan 0 0 0 1", "training_view 0 0 0 0 0 0 0"}) {
    write_map(path("map.ply"), random_gaussians(1, 0), {note});
    try {
      read_map_header(path("map.ply"));
      ADD_FAILURE() << note;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("map.ply: header: training_view")) << note;
    }
  }
}

TEST_F(MapFile, RemembersItsBlendOrder) {
  for (const BlendOrder order : {BlendOrder::depth, BlendOrder::distance}) {
    write_map(path("map.ply"), random_gaussians(3, 0), {"seed 42", blend_order_line(order)});
    EXPECT_EQ(read_map_header(path("map.ply")).rasterizer.order, order);
    EXPECT_EQ(read_map_header(path("map.ply")).notes, (std::vector<std::string>{"seed 42", blend_order_line(order)}));
  }
  write_map(path("plain.ply"), random_gaussians(3, 0));
  EXPECT_EQ(read_map_header(path("plain.ply")).rasterizer.order, BlendOrder::depth);
  write_map(path("map.ply"), random_gaussians(1, 0), {"blend_order size"});
  try {
    read_map_header(path("map.ply"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("map.ply: header: blend_order: must be depth or distance, is \"size\""));
  }
}

TEST_F(MapFile, PlacesAreThinned) {
  std::vector<SE3> views;
  for (int k = 0; k < 100; ++k) views.emplace_back(Eigen::Quaterniond::Identity(), Eigen::Vector3d(0.01 * k, 0.0, 0.0));
  EXPECT_EQ(thinned_places(views, {0.095, 0.2, 1000}).size(), 10U);
  EXPECT_LE(thinned_places(views, {0.005, 0.2, 7}).size(), 7U);
  // Different directions from one position also count as different places.
  for (int k = 0; k < 100; ++k)
    views[static_cast<std::size_t>(k)] = SE3(so3_exp({0.0, 0.01 * k, 0.0}), Eigen::Vector3d::Zero());
  EXPECT_EQ(thinned_places(views, {0.1, 0.095, 1000}).size(), 10U);
  EXPECT_TRUE(thinned_places({}).empty());
}

TEST_F(MapFile, HeaderIsThatOfPublicPrograms) {
  write_map(path("map.ply"), random_gaussians(2, 1), {"iterations 3000", "seed 42"});
  const std::string text = read_text("map.ply");
  const std::string header = text.substr(0, text.find("end_header"));
  EXPECT_THAT(header, HasSubstr("format binary_little_endian 1.0\n"));
  EXPECT_THAT(header, HasSubstr("element vertex 2\n"));
  EXPECT_THAT(header, HasSubstr("comment odosplat map, format 1\n"));
  EXPECT_THAT(header, HasSubstr("comment camera: x right, y down, z forward"));
  EXPECT_THAT(header, HasSubstr("comment iterations 3000\ncomment seed 42\n"));
  std::string expected;
  for (const std::string name : {"x", "y", "z", "nx", "ny", "nz", "f_dc_0", "f_dc_1", "f_dc_2"})
    expected += "property float " + name + "\n";
  for (int i = 0; i < 9; ++i) expected += "property float f_rest_" + std::to_string(i) + "\n";
  for (const std::string name : {"opacity", "scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"})
    expected += "property float " + name + "\n";
  EXPECT_THAT(header, HasSubstr(expected));
  // 2 rows of 26 floats after the header.
  EXPECT_EQ(text.size(), text.find("end_header\n") + 11 + std::size_t{2} * 26 * 4);
}

TEST_F(MapFile, RestOfHarmonicsIsChannelAfterChannel) {
  Gaussians g = random_gaussians(1, 1);
  for (std::size_t i = 0; i < 12; ++i) g.sh[i] = static_cast<float>(i);  // coefficient k, channel c: 3 k + c
  write_map(path("map.ply"), g);
  const std::string text = read_text("map.ply");
  float row[26];
  std::copy_n(text.data() + text.find("end_header\n") + 11, sizeof(row), reinterpret_cast<char*>(row));
  EXPECT_THAT(std::vector<float>(row + 6, row + 18), testing::ElementsAre(0, 1, 2, 3, 6, 9, 4, 7, 10, 5, 8, 11));
}

TEST_F(MapFile, NormalIsTheShortestAxis) {
  Gaussians g = random_gaussians(1, 0);
  g.log_scales = {-1.0F, -4.0F, -2.0F};
  g.rotations = {2.0F, 0.0F, 0.0F, 2.0F};  // 90 degrees about z, not normalised: y becomes -x
  write_map(path("map.ply"), g);
  const std::string text = read_text("map.ply");
  float row[17];
  std::copy_n(text.data() + text.find("end_header\n") + 11, sizeof(row), reinterpret_cast<char*>(row));
  EXPECT_NEAR(row[3], -1.0F, 1e-6F);
  EXPECT_NEAR(row[4], 0.0F, 1e-6F);
  EXPECT_NEAR(row[5], 0.0F, 1e-6F);
}

const std::string ascii_properties =
    "property double rot_0\nproperty float rot_1\nproperty float rot_2\nproperty float rot_3\n"
    "property float x\nproperty float y\nproperty float z\n"
    "property float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2\n"
    "property float opacity\nproperty float scale_0\nproperty float scale_1\nproperty float scale_2\n";

TEST_F(MapFile, ReadsAsciiInAnyOrderAndType) {
  write_text("map.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + ascii_properties +
                            "end_header\n1 0 0 0 1.5 2.5 3.5 0.1 0.2 0.3 2 -4 -5 -6\n");
  const Gaussians g = read_map(path("map.ply")).gaussians;
  EXPECT_EQ(g.sh_degree, 0);
  EXPECT_THAT(g.positions, testing::ElementsAre(1.5F, 2.5F, 3.5F));
  EXPECT_THAT(g.rotations, testing::ElementsAre(1, 0, 0, 0));
  EXPECT_THAT(g.log_scales, testing::ElementsAre(-4, -5, -6));
  EXPECT_THAT(g.opacity_logits, testing::ElementsAre(2));
}

// x y z, f_dc_0..2, opacity, scale_0..2, rot_0..3
std::string ascii_map(const std::vector<std::string>& rows, const std::string& type = "float",
                      const std::string& left_out = "") {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(rows.size()) + "\n";
  for (const char* name : {"x", "y", "z", "f_dc_0", "f_dc_1", "f_dc_2", "opacity", "scale_0", "scale_1", "scale_2",
                           "rot_0", "rot_1", "rot_2", "rot_3"}) {
    if (name != left_out) text += "property " + type + " " + name + "\n";
  }
  text += "end_header\n";
  for (const std::string& row : rows) text += row + "\n";
  return text;
}
/// Message of the InputError from parsing; empty if there is none.
std::string parse_fault(const std::string& text) {
  try {
    parse_map("m.ply", text);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}
const std::string good_row = "1 2 3 0.1 0.2 0.3 2 -4 -5 -6 1 0 0 0";

TEST_F(MapFile, OpacitiesOfZeroAndOneHaveInfiniteLogits) {
  const Gaussians g =
      parse_map("m.ply",
                ascii_map({"1 2 3 0.1 0.2 0.3 inf -4 -5 -6 1 0 0 0", "1 2 3 0.1 0.2 0.3 -inf -4 -5 -inf 1 0 0 0"}))
          .gaussians;
  ASSERT_EQ(g.size(), 2U);
  EXPECT_EQ(1.0F / (1.0F + std::exp(-g.opacity_logits[0])), 1.0F);
  EXPECT_LT(1.0F / (1.0F + std::exp(-g.opacity_logits[1])), 1e-6F);
  EXPECT_EQ(g.log_scales[5], -23.0F);
}

TEST_F(MapFile, AFewBrokenRowsAreLeftOutAndNamed) {
  std::vector<std::string> rows(20, good_row);
  rows[3] = "4 nan 3 0.1 0.2 0.3 2 -4 -5 -6 1 0 0 0";
  rows[7] = "4 2 3 0.1 0.2 0.3 2 -4 inf -6 1 0 nan 0";
  rows[19] = "9 2 3 0.1 0.2 0.5 2 -4 -5 -6 1 0 0 0";
  testing::internal::CaptureStderr();
  const Gaussians g = parse_map("m.ply", ascii_map(rows)).gaussians;
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_THAT(said, HasSubstr("m.ply: 2 of 20 Gaussians are broken and left out (Gaussian 3: y is not finite)"));
  ASSERT_EQ(g.size(), 18U);
  g.check();
  EXPECT_EQ(g.positions[3 * 17], 9.0F);
  EXPECT_EQ(g.sh[3 * 17 + 2], 0.5F);
  for (std::size_t i = 0; i < 17; ++i) EXPECT_EQ(g.positions[3 * i], 1.0F);
  rows[0] = rows[3];
  EXPECT_EQ(parse_fault(ascii_map(rows)), "m.ply: Gaussian 0: y is not finite; 3 of 20 Gaussians are broken");
}

TEST_F(MapFile, WhatNoDeviceCanDrawIsLeftOutAndNamed) {
  const std::vector<std::pair<std::string, std::string>> broken = {
      {"1 2 3 0.1 0.2 0.3 2 -4 -5 -6 0 0 0 0", "its rotation has length 0"},
      {"1 2 3 0.1 0.2 0.3 2 -4 -5 -6 1e-30 0 1e-30 0", "its rotation has length 0"},
      {"1 2 3 0.1 0.2 0.3 2 -4 -5 -6 1e30 0 0 0", "the length of its rotation is 1e+30, beyond 1e+15"},
      {"1 2 3 0.1 0.2 0.3 2 -4 80 -6 1 0 0 0", "its scale [ln m] is 80, beyond 13.8"},
      {"1 2 -1e38 0.1 0.2 0.3 2 -4 -5 -6 1 0 0 0", "its position [m] is -1e+38, beyond 1e+07"},
      {"1 2 3 0.1 3e38 0.3 2 -4 -5 -6 1 0 0 0", "its colour is 3e+38, beyond 1e+04"},
  };
  for (const auto& [row, wrong] : broken) {
    std::vector<std::string> rows(20, good_row);
    rows[5] = row;
    testing::internal::CaptureStderr();
    const Gaussians g = parse_map("m.ply", ascii_map(rows)).gaussians;
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                HasSubstr("m.ply: 1 of 20 Gaussians are broken and left out (Gaussian 5: " + wrong + ")"));
    EXPECT_EQ(g.size(), 19U);
    EXPECT_EQ(parse_fault(ascii_map({row})), "m.ply: Gaussian 0: " + wrong);
  }
  // Opacities and sizes are not limited.
  for (const char* row : {"1 2 3 0.1 0.2 0.3 1e30 -4 -5 -6 1 0 0 0", "1 2 3 0.1 0.2 0.3 -1e30 -4 -5 -6 1 0 0 0",
                          "1 2 3 0.1 0.2 0.3 2 -1e30 -1e30 -1e30 0 0 -9 0"}) {
    EXPECT_EQ(parse_fault(ascii_map({row})), "") << row;
  }
}

// The limits are those of the kernels: Gaussians just within them are drawn with finite values.
TEST_F(MapFile, WhatIsWithinTheLimitsIsDrawn) {
  const auto context = compute::Context::open();
  const Camera camera{33, 33, 40.0, 40.0, 16.0, 16.0};
  const std::vector<std::string> rows = {
      "0 0 4 0.1 0.2 0.3 20 -1 -1 -1 1e-15 0 0 0",     "0 0 4 0.1 0.2 0.3 20 -1 -1 -1 0 9e14 0 0",
      "0 0 2e4 0.1 0.2 0.3 20 13.8 13.8 13.8 1 0 0 0", "0 0 4 0.1 0.2 0.3 20 -1e30 -1e30 -1e30 1 0 0 0",
      "0 0 4 9999 0.2 0.3 20 -1 -1 -1 1 0 0 0",
  };
  for (const std::string& row : rows) {
    GaussianView view(context, parse_map("m.ply", ascii_map({row})));
    ViewRequest request;
    request.color = true;
    request.alpha = true;
    const ViewImages image = view.render(camera, SE3(), request);
    EXPECT_GT(image.alpha(16, 16), 0.5F) << row;
    EXPECT_GT(image.depth(16, 16), 1.0F) << row;
    for (const cv::Vec3f& color : image.color)
      for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(color[c])) << row;
  }
}

TEST_F(MapFile, FieldsOfTheHeaderAreChecked) {
  const auto header_fault = [&](const std::vector<std::string>& comments, bool ours = true) {
    std::string text = ascii_map({good_row});
    std::string lines = ours ? "comment odosplat map, format 1\n" : "";
    for (const std::string& comment : comments) lines += "comment " + comment + "\n";
    text.insert(text.find("element"), lines);
    write_text("m.ply", text);
    const std::string said = fault("m.ply");
    // Reading only the header gives the same error.
    try {
      read_map_header(path("m.ply"));
      EXPECT_EQ(said, "");
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), said);
    }
    return said.empty() ? said : said.substr(path("m.ply").size());
  };
  EXPECT_EQ(header_fault({"blend_order distance", "dilation 0.3", "seed 42", "sigma_spread 5"}), "");
  EXPECT_EQ(header_fault({"odosplat map, format 2"}, false),
            ": header: format: is `2`, this program reads format 1: another version wrote it");
  EXPECT_EQ(header_fault({"blend_order depth", "blend_order distance"}), ": header: blend_order: comes twice");
  EXPECT_EQ(header_fault({"dilation nan"}), ": header: dilation: must be a number in 0.01..100, is `nan`");
  EXPECT_EQ(header_fault({"sigma_spread 1e30"}), ": header: sigma_spread: must be a number in 0..100, is `1e30`");
  EXPECT_EQ(header_fault({"sigma_slope_px 1 2"}), ": header: sigma_slope_px: must be a number in 0..100, is `1 2`");
  EXPECT_EQ(header_fault({"quality_images -5"}),
            ": header: quality_images: must be a whole number of at least 0, is `-5`");
  EXPECT_EQ(header_fault({"quality_unseen_share 7"}),
            ": header: quality_unseen_share: must be a number in 0..1, is `7`");
  EXPECT_EQ(header_fault({"iterations_done -1"}),
            ": header: iterations_done: must be a whole number of at least 0, is `-1`");
  EXPECT_EQ(header_fault({"seed 0.5"}), ": header: seed: must be a whole number of at least 0, is `0.5`");
  // Comments of other programs may begin with the same words and have any content.
  EXPECT_EQ(header_fault({"iterations were many", "iterations 3"}, false), "");
  EXPECT_EQ(header_fault({"iterations were many", "made by hand"}, false), "");
  EXPECT_EQ(read_map_header(path("m.ply")).notes, (std::vector<std::string>{"made by hand"}));
  EXPECT_EQ(header_fault({"blend_order depth", "blend_order depth"}, false), ": header: blend_order: comes twice");
}

TEST_F(MapFile, EverySettingOfTrainingIsRead) {
  for (const char* preset : {"default", "paper"}) {
    TrainerOptions options = TrainerOptions::preset(preset, 10);
    options.rasterizer.dilation = 0.1F;
    options.rasterizer.compensated = true;
    write_map(path("m.ply"), random_gaussians(2, 0), options.describe());
    EXPECT_EQ(fault("m.ply"), "") << preset;
    const MapHeader view = read_map_header(path("m.ply"));
    EXPECT_EQ(view.rasterizer.dilation, 0.1F);
    EXPECT_TRUE(view.rasterizer.compensated);
    EXPECT_EQ(view.rasterizer.order, options.rasterizer.order);
  }
}

TEST_F(MapFile, TwoScalesAreFlatDiscs) {
  const Gaussians g =
      parse_map("m.ply", ascii_map({"1 2 3 0.1 0.2 0.3 2 -4 -5 1 0 0 0"}, "float", "scale_2")).gaussians;
  EXPECT_THAT(g.log_scales, testing::ElementsAre(-4, -5, -13.8155F));
  // A missing scale other than the third is still an error.
  EXPECT_EQ(parse_fault(ascii_map({"1 2 3 0.1 0.2 0.3 2 -4 -5 1 0 0 0"}, "float", "scale_1")),
            "m.ply: vertex: has no property scale_1");
}

TEST_F(MapFile, WholeNumbersAreRefusedByPropertyAndType) {
  const std::string row = "1 2 3 4 5 6 7 8 9 10 11 12 13 14";
  EXPECT_EQ(
      parse_fault(ascii_map({row}, "ushort")),
      "m.ply: vertex: x is of type ushort, must be float or double (half floats stored as ushort: export the map as "
      "float)");
  EXPECT_EQ(parse_fault(ascii_map({row}, "int")), "m.ply: vertex: x is of type int, must be float or double");
  EXPECT_EQ(parse_map("m.ply", ascii_map({row}, "double")).gaussians.size(), 1U);
}

TEST_F(MapFile, NamesMayBeInAnyCaseBehindAByteOrderMark) {
  std::string text = ascii_map({good_row});
  for (const char* name : {" x", " y", " z", " f_dc_0", " opacity", " scale_0", " rot_0"}) {
    std::string upper = name;
    for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    text.replace(text.find(std::string(name) + "\n"), upper.size(), upper);
  }
  text.insert(text.find("element"), "comment blend_order distance\n");
  text = "\xEF\xBB\xBF" + text;
  EXPECT_EQ(parse_map("m.ply", text).gaussians.positions, (std::vector<float>{1, 2, 3}));
  write_text("m.ply", text);
  EXPECT_TRUE(is_map_file(path("m.ply")));
  EXPECT_EQ(read_map_header(path("m.ply")).rasterizer.order, BlendOrder::distance);
}

TEST_F(MapFile, APackedPlyIsRead) {
  write_text("m.compressed.ply",
             "ply\nformat ascii 1.0\nelement chunk 1\nproperty float min_x\nelement vertex 1\nproperty uint "
             "packed_position\nproperty uint packed_rotation\nend_header\n1\n2 3\n");
  EXPECT_TRUE(is_map_file(path("m.compressed.ply")));
  EXPECT_THAT(fault("m.compressed.ply"), HasSubstr("packed_scale"));
}

TEST_F(MapFile, FaultsNameTheFile) {
  EXPECT_THAT(fault("none.ply"), HasSubstr(path("none.ply")));

  write_text("empty.ply", "ply\nformat ascii 1.0\nelement vertex 0\n" + ascii_properties + "end_header\n");
  EXPECT_EQ(fault("empty.ply"), path("empty.ply") + ": holds no Gaussians");

  write_text("missing.ply",
             "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
             "z\nend_header\n1 2 3\n");
  EXPECT_THAT(fault("missing.ply"), testing::AllOf(HasSubstr(path("missing.ply")), HasSubstr("f_dc_0")));

  write_text("nan.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + ascii_properties +
                            "end_header\n1 0 0 0 1.5 2.5 3.5 0.1 0.2 0.3 nan -4 -5 -6\n");
  EXPECT_EQ(fault("nan.ply"), path("nan.ply") + ": Gaussian 0: opacity is not finite");

  write_text("rest.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + ascii_properties +
                             "property float f_rest_0\nend_header\n1 0 0 0 1.5 2.5 3.5 0.1 0.2 0.3 1 -4 -5 -6 0\n");
  EXPECT_THAT(fault("rest.ply"), testing::AllOf(HasSubstr(path("rest.ply")), HasSubstr("f_rest")));

  write_map(path("whole.ply"), random_gaussians(3, 2));
  const std::string whole = read_text("whole.ply");
  write_text("cut.ply", whole.substr(0, whole.size() - 7));
  EXPECT_THAT(fault("cut.ply"), HasSubstr(path("cut.ply")));
}

TEST_F(MapFile, RefusesToWriteNothingOrNowhere) {
  EXPECT_THROW(write_map(path("map.ply"), Gaussians{}), InputError);
  EXPECT_FALSE(std::filesystem::exists(path("map.ply")));
  EXPECT_THROW(write_map("/proc/odosplat/map.ply", random_gaussians(1, 0)), InputError);
}

}  // namespace
}  // namespace odosplat
