// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Files with more rows than their headers state.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/io/cloud/ply.hpp"
#include "odosplat/io/sequence/colmap_model.hpp"
#include "tests/io/cloud/cloud_bytes.hpp"
#include "tests/io/cloud/cloud_checks.hpp"
#include "tests/io/sequence/colmap_writer.hpp"

namespace odosplat {
namespace {

using test::fault;
using test::little;
using testing::HasSubstr;

/// The warnings printed while a cloud is read; its number of points is stored in `n`.
std::string warning_of(const std::string& name, const std::string& bytes, std::size_t& n) {
  testing::internal::CaptureStderr();
  n = parse_point_cloud(name, bytes).size();
  return testing::internal::GetCapturedStderr();
}

void expect_warning(const std::string& name, const std::string& bytes, std::size_t points, const std::string& warning) {
  SCOPED_TRACE(name + ": " + warning);
  std::size_t n = 0;
  const std::string said = warning_of(name, bytes, n);
  EXPECT_EQ(n, points);
  if (warning.empty()) {
    EXPECT_EQ(said, "");
  } else {
    EXPECT_THAT(said, HasSubstr(name + ": " + warning));
    EXPECT_EQ(said.find(name + ": "), said.rfind(name + ": ")) << said;  // once
  }
}

std::string ply(const std::string& format, int rows, const std::string& more_elements = "") {
  return "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(rows) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\nproperty uchar green\n"
         "property uchar blue\n" +
         more_elements + "end_header\n";
}
const std::string ply_row = little(1.0F, 2.0F, 3.0F) + "abc";

TEST(LeftOver, PlySaysWhatItsHeaderLeavesOut) {
  const std::string three = ply_row + ply_row + ply_row;
  const std::string binary = "binary_little_endian";
  const std::string rest = "the header promises 1 rows of vertex, the file goes on for ";
  expect_warning("c.ply", ply(binary, 3) + three, 3, "");
  expect_warning("c.ply", ply(binary, 1) + three, 1, rest + "30 bytes, room for 2 rows, which are not read");
  expect_warning("c.ply", ply(binary, 3) + three + "\n", 3, "");  // padding
  expect_warning("c.ply", ply("ascii", 1) + "1 2 3 4 5 6\n1 2 3 4 5 6\n\n", 1, rest + "1 lines, which are not read");
  expect_warning("c.ply", ply("ascii", 1) + "1 2 3 4 5 6\n\n  \n", 1, "");

  testing::internal::CaptureStderr();
  EXPECT_EQ(parse_ply("p.ply", ply(binary, 1) + three).element("vertex").count, 1U);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("p.ply: " + rest + "30 bytes"));
}

// A mesh is a cloud with further elements after the points.
TEST(LeftOver, FurtherElementsAreNone) {
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\n";
  const std::string face = little(std::uint8_t{3}, std::int32_t{0}, std::int32_t{1}, std::int32_t{2});
  const std::string mesh = ply("binary_little_endian", 1, faces) + ply_row + face + face;
  expect_warning("c.ply", mesh, 1, "");
  expect_warning("c.ply", mesh + face, 1, "the header promises 2 rows of face, the file goes on for 13 bytes");
  expect_warning("c.ply", mesh.substr(0, mesh.size() - 1), 1, "behind its points the file is damaged (the header");
  expect_warning("c.ply", ply("ascii", 1, faces) + "1 2 3 4 5 6\n3 0 1 2\n3 2 1 0\n", 1, "");
}

TEST(LeftOver, PcdSaysWhatItsHeaderLeavesOut) {
  const auto header = [](const std::string& data) {
    return test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", 1, data);
  };
  const std::string row = little(1.0F, 2.0F, 3.0F);
  const std::string rest = "the header promises 1 points, the file goes on for ";
  expect_warning("c.pcd", header("binary") + row, 1, "");
  expect_warning("c.pcd", header("binary") + row + row + row, 1, rest + "2 more, which are not read");
  expect_warning("c.pcd", header("ascii") + "1 2 3\n\n4 5 6\n", 1, rest + "1 lines, which are not read");
  expect_warning("c.pcd", header("ascii") + "1 2 3\n\n", 1, "");
  expect_warning("c.pcd", header("binary_compressed") + test::pcd_compressed(row + row), 1, rest + "1 more");
}

TEST(LeftOver, LasSaysWhatItsHeaderLeavesOut) {
  test::LasFile las;
  las.points = test::points;
  expect_warning("c.las", las.bytes(), 3, "");
  las.promised = 1;
  expect_warning("c.las", las.bytes(), 1, "the header promises 1 points, the file goes on for 2 more");
  // Data after the points that the header declares.
  las.minor = 4;
  las.promised = UINT64_MAX;
  std::string bytes = las.bytes();
  bytes.replace(235, 8, little(static_cast<std::uint64_t>(bytes.size())));
  expect_warning("c.las", bytes + std::string(100, 'e'), 3, "");
  bytes.replace(107, 4, little(std::uint32_t{2}));
  EXPECT_EQ(fault("c.las", bytes), "c.las: header: its two counts of points are 2 and 3");
}

TEST(LeftOver, TextThatBeginsWithACountIsHeldToIt) {
  const std::string rows = "1 2 3 4 5 6 7\n2 2 3 4 5 6 7\n";
  expect_warning("c.pts", "2\n" + rows, 2, "");
  expect_warning("c.pts", "1\n" + rows, 2, "its first line promises 1 points, the file holds 2, and all are read");
  EXPECT_EQ(fault("c.pts", "3\n" + rows), "c.pts: its first line promises 3 points, the file holds 2");
  EXPECT_EQ(fault("c.pts", "1.5\n" + rows), "c.pts: line 1: `1.5` is no number of points");
  EXPECT_EQ(fault("c.pts", "-2\n" + rows), "c.pts: line 1: `-2` is no number of points");
}

TEST(LeftOver, ColmapsBinariesEndWithTheirLastEntry) {
  test::ColmapModel model;
  model.cameras = {{7, 4, "OPENCV", 16, 12, {20.0, 21.0, 8.25, 6.5, 0.01, -0.02, 0.003, -0.004}}};
  model.images = {{1, {}, 7, "a.png", 2}};
  model.points.points = {{1, 2, 3}};
  model.points.colors = {{0, 1, 0.2F}};
  const auto refused = [](auto parse, const std::string& bytes) {
    EXPECT_THAT(test::error_of([&] { parse("m.bin", bytes + std::string(3, 'x')); }),
                HasSubstr("and goes on for 3 bytes behind them"));
    EXPECT_NO_THROW(parse("m.bin", bytes));
  };
  refused(parse_colmap_cameras_binary, model.cameras_binary());
  refused(parse_colmap_images_binary, model.images_binary());
  refused(parse_colmap_points_binary, model.points_binary());
}

}  // namespace
}  // namespace odosplat
