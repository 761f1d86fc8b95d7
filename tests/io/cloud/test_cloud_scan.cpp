// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/cloud_scan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tests/io/cloud/cloud_checks.hpp"

namespace odosplat {
namespace {

using Eigen::Vector3f;
using test::error_of;
using test::fault;
using test::little;
using test::TempFolder;
using testing::HasSubstr;

// An element with a list before the vertices, doubles, an unused property, a list in the vertices; several batches.
TEST(CloudScan, PlyOfEveryEncoding) {
  const std::size_t n = 66000;
  const auto header = [&](const std::string& format, bool with_list) {
    return "ply\nformat " + format + " 1.0\nelement face 2\nproperty list uchar short i\nelement vertex " +
           std::to_string(n) + "\nproperty double x\nproperty ushort quality\nproperty float y\nproperty int z\n" +
           (with_list ? "property list uchar uchar tags\n" : "") +
           "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  };
  const auto x_of = [](std::size_t i) { return 0.5 * static_cast<double>(i); };
  const auto expect_right = [&](const std::string& bytes) {
    const PointCloud cloud = parse_point_cloud("c.ply", bytes);
    ASSERT_EQ(cloud.size(), n);
    ASSERT_TRUE(cloud.has_colors());
    EXPECT_FALSE(cloud.has_normals());
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(cloud.points[i], Vector3f(static_cast<float>(x_of(i)), 1.25F, static_cast<float>(i % 1000)));
      ASSERT_EQ(cloud.colors[i].x(), static_cast<float>(i % 256) / 255.0F);
    }
  };
  for (const bool with_list : {false, true}) {
    for (const bool big : {false, true}) {
      const auto ordered = [big](std::string value) {
        if (big) std::reverse(value.begin(), value.end());
        return value;
      };
      std::string bytes = header(big ? "binary_big_endian" : "binary_little_endian", with_list);
      for (int face = 0; face < 2; ++face) bytes += little(std::uint8_t{3}) + std::string(6, 'f');
      for (std::size_t i = 0; i < n; ++i) {
        bytes += ordered(little(x_of(i))) + ordered(little(std::uint16_t{7})) + ordered(little(1.25F)) +
                 ordered(little(static_cast<std::int32_t>(i % 1000)));
        if (with_list) bytes += std::string(1, static_cast<char>(i % 3)) + std::string(i % 3, 't');
        bytes += little(static_cast<std::uint8_t>(i % 256), std::uint8_t{2}, std::uint8_t{3});
      }
      SCOPED_TRACE(bytes.substr(0, 30));
      expect_right(bytes);
      EXPECT_THAT(fault("c.ply", bytes.substr(0, bytes.size() - 1)), HasSubstr("the file holds 65999"));
    }
  }
  std::string text = header("ascii", true) + "3 1 2 3\n0\n";
  for (std::size_t i = 0; i < n; ++i) {
    text +=
        std::to_string(x_of(i)) + " 7 1.25 " + std::to_string(i % 1000) + " 1 9 " + std::to_string(i % 256) + " 2 3\n";
  }
  expect_right(text);
}

TEST(CloudScan, BatchesAreCutAndOrderIsKept) {
  std::string text;
  for (int i = 0; i < 150000; ++i) text += std::to_string(i) + " 0 0\n";
  std::vector<std::size_t> sizes;
  std::size_t next = 0;
  scan_cloud_bytes("c.xyz", text, [&](const CloudBatch& batch) {
    sizes.push_back(batch.points.size());
    for (const Eigen::Vector3d& p : batch.points) EXPECT_EQ(p.x(), static_cast<double>(next++));
  });
  EXPECT_EQ(sizes, (std::vector<std::size_t>{65536, 65536, 18928}));
}

TEST(CloudScan, UnknownFilesAreRefused) {
  const TempFolder temp;
  EXPECT_EQ(fault("c.bin", "1 2 3\n"),
            "c.bin: is no point cloud of a known format (PLY, PCD, LAS, or text as .xyz .csv .txt)");
  EXPECT_EQ(fault("c", ""), "c: is no point cloud of a known format (PLY, PCD, LAS, or text as .xyz .csv .txt)");
  EXPECT_EQ(error_of([] { scan_cloud("/nowhere.xyz", [](const CloudBatch&) {}); }), "/nowhere.xyz: is missing");
  EXPECT_EQ(error_of([&] { scan_cloud(temp.path(), [](const CloudBatch&) {}); }),
            temp.path() + ": is not a regular file but a folder");
}

}  // namespace
}  // namespace odosplat
