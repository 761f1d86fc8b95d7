// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/cloud_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/core/random.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using Eigen::Vector3f;
using test::error_of;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

PointCloud cloud_of(const std::string& properties, const std::string& rows, int count) {
  return parse_point_cloud("c.ply", "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) + "\n" +
                                        properties + "end_header\n" + rows);
}

const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
const std::string normals = "property float nx\nproperty float ny\nproperty float nz\n";

std::string rgb(const std::string& type, const std::string& prefix = "") {
  return "property " + type + " " + prefix + "red\nproperty " + type + " " + prefix + "green\nproperty " + type + " " +
         prefix + "blue\n";
}

TEST(CloudFile, RoundTrip) {
  const TempFolder temp;
  Random random(1);
  PointCloud cloud;
  const auto value = [&] { return static_cast<float>(random.uniform(-5.0, 5.0)); };
  for (int i = 0; i < 1000; ++i) {
    cloud.points.emplace_back(value(), value(), value());
    cloud.normals.push_back(Vector3f(value(), value(), value()).normalized());
    cloud.colors.emplace_back(static_cast<float>(i % 256) / 255.0F, 0.0F, 1.0F);
  }
  write_point_cloud(temp / "c.ply", cloud);
  const PointCloud read = read_point_cloud(temp / "c.ply");
  EXPECT_EQ(read.points, cloud.points);
  ASSERT_TRUE(read.has_colors());
  ASSERT_TRUE(read.has_normals());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_LT((read.colors[i] - cloud.colors[i]).norm(), 1e-6F);
    EXPECT_LT((read.normals[i] - cloud.normals[i]).norm(), 1e-6F);
  }
  cloud.colors.clear();
  cloud.normals.clear();
  write_point_cloud(temp / "bare.ply", cloud);
  const PointCloud bare = read_point_cloud(temp / "bare.ply");
  EXPECT_EQ(bare.points, cloud.points);
  EXPECT_FALSE(bare.has_colors());
  EXPECT_FALSE(bare.has_normals());
}

TEST(CloudFile, ReadsColoursOfEveryKind) {
  const Vector3f expected(1.0F, 0.0F, 0.2F);
  const auto first = [](const std::string& properties, const std::string& row) {
    return cloud_of(properties, row, 1).colors.at(0);
  };
  EXPECT_LT((first(xyz + rgb("uchar"), "1 2 3 255 0 51\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("ushort"), "1 2 3 65535 0 13107\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("float"), "1 2 3 1 0 0.2\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("ushort"), "1 2 3 255 0 51\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("uint"), "1 2 3 65535 0 13107\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("float"), "1 2 3 255 0 51\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("float"), "1 2 3 65535 0 13107\n") - expected).norm(), 1e-6F);
  EXPECT_LT((first(xyz + rgb("uchar", "diffuse_"), "1 2 3 255 0 51\n") - expected).norm(), 1e-6F);
  EXPECT_FALSE(cloud_of(xyz + "property uchar red\n", "1 2 3 4\n", 1).has_colors());
}

TEST(CloudFile, NamesOfPropertiesMayBeInAnyCase) {
  const std::string upper =
      "property float X\nproperty float Y\nproperty float Z\nproperty uchar Red\nproperty uchar Green\n"
      "property uchar Blue\nproperty float NormalX\nproperty float NormalY\nproperty float NormalZ\n";
  const PointCloud cloud = cloud_of(upper, "1 2 3 255 0 51 0 0 2\n", 1);
  EXPECT_EQ(cloud.points.at(0), Vector3f(1, 2, 3));
  EXPECT_LT((cloud.colors.at(0) - Vector3f(1.0F, 0.0F, 0.2F)).norm(), 1e-6F);
  EXPECT_EQ(cloud.normals.at(0), Vector3f(0, 0, 1));
}

TEST(CloudFile, AByteOrderMarkBeforeTheHeaderIsPassedOver) {
  const std::string text = "\xEF\xBB\xBFply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "end_header\n1 2 3\n";
  EXPECT_EQ(parse_point_cloud("c.ply", text).points.at(0), Vector3f(1, 2, 3));
}

TEST(CloudFile, ColoursBeyond16BitsAreRefused) {
  EXPECT_EQ(error_of([] { cloud_of(xyz + rgb("int"), "1 2 3 70000 0 0\n", 1); }),
            "c.ply: vertex 1: its colour is negative or not finite");
}

TEST(CloudFile, FormatsThatAreNotReadAreNamed) {
  const auto fault = [](const std::string& name, const std::string& bytes) {
    return error_of([&] { parse_point_cloud(name, bytes); });
  };
  EXPECT_THAT(fault("a.spz", "\x1f\x8b\x08"),
              HasSubstr("a.spz: is a map of Gaussians in SPZ: `odosplat convert` makes a PLY of it"));
  EXPECT_THAT(fault("a.bin", "NGSP"), HasSubstr("is a map of Gaussians in SPZ"));
  EXPECT_THAT(fault("a.SOG", "PK\x03\x04"), HasSubstr("is a map of Gaussians in SOG"));
  EXPECT_THAT(fault("a.ksplat", "x"), HasSubstr("KSPLAT"));
  EXPECT_THAT(fault("a.ply.gz", "\x1f\x8b\x08"), HasSubstr("is compressed (gzip)"));
  EXPECT_THAT(fault("a.zip", "PK\x03\x04"), HasSubstr("is a ZIP archive"));
  EXPECT_THAT(fault("a.e57", "ASTM-E57"), HasSubstr("E57"));
  EXPECT_THAT(error_of([] { cloud_of("property uint packed_position\nproperty uint packed_color\n", "1 2\n", 1); }),
              HasSubstr("c.ply: is a packed PLY (SuperSplat), a map of Gaussians"));
}

TEST(CloudFile, PropertiesMayComeInAnyOrderAndType) {
  const PointCloud cloud =
      cloud_of("property double z\nproperty float intensity\nproperty double x\nproperty int y\n", "3 9 1.5 2\n", 1);
  EXPECT_EQ(cloud.points.at(0), Vector3f(1.5F, 2.0F, 3.0F));
}

TEST(CloudFile, PointsThatAreNotFiniteAreLeftOut) {
  const PointCloud cloud =
      cloud_of(xyz + normals + rgb("uchar"), "1 0 0 0 0 2 10 0 0\nnan 0 0 nan nan nan 20 0 0\n3 0 0 0 3 0 30 0 0\n", 3);
  ASSERT_EQ(cloud.size(), 2U);
  EXPECT_EQ(cloud.points[1], Vector3f(3, 0, 0));
  EXPECT_EQ(cloud.normals[1], Vector3f(0, 1, 0));
  EXPECT_NEAR(cloud.colors[1].x(), 30.0F / 255.0F, 1e-6F);
}

TEST(CloudFile, NormalsAreAllOrNothing) {
  EXPECT_FALSE(cloud_of(xyz + normals, "1 0 0 0 0 1\n2 0 0 0 0 0\n", 2).has_normals());
  EXPECT_FALSE(cloud_of(xyz + normals, "1 0 0 0 0 nan\n", 1).has_normals());
  EXPECT_TRUE(cloud_of(xyz + normals, "1 0 0 0 0 5\n", 1).has_normals());
}

TEST(CloudFile, FaultsAreNamed) {
  EXPECT_EQ(error_of([] { cloud_of("property float x\nproperty float y\n", "1 2\n", 1); }),
            "c.ply: vertex: has no property z");
  EXPECT_EQ(error_of([] { cloud_of(xyz, "", 0); }), "c.ply: holds no point");
  EXPECT_EQ(error_of([] { cloud_of(xyz, "nan nan nan\n", 1); }), "c.ply: holds no point");
  EXPECT_EQ(error_of([] { cloud_of(xyz + rgb("float"), "1 2 3 nan 0 0\n", 1); }),
            "c.ply: vertex 1: its colour is negative or not finite");
  EXPECT_EQ(error_of([] { cloud_of(xyz + rgb("int"), "1 2 3 -1 0 0\n", 1); }),
            "c.ply: vertex 1: its colour is negative or not finite");
  EXPECT_EQ(error_of([] { cloud_of(xyz, "1 2 3\n", 7); }),
            "c.ply: the header promises 7 rows of vertex, the file holds 1");
  EXPECT_EQ(error_of([] { read_point_cloud("/nowhere.ply"); }), "/nowhere.ply: is missing");
}

TEST(CloudFile, AnEmptyCloudIsWrittenAndRefused) {
  const TempFolder temp;
  write_point_cloud(temp / "c.ply", {});
  EXPECT_EQ(error_of([&] { read_point_cloud(temp / "c.ply"); }), temp / "c.ply" + ": holds no point");
}

}  // namespace
}  // namespace odosplat
