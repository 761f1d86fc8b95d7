// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "odosplat/io/cloud/cloud_scan.hpp"
#include "tests/io/cloud/cloud_checks.hpp"

namespace odosplat {
namespace {

using test::expect_points;
using test::fault;
using test::LasFile;
using test::little;
using test::points;
using testing::HasSubstr;

TEST(CloudLas, OfEveryVersionAndFormat) {
  for (int minor = 0; minor <= 4; ++minor) {
    for (int format = 0; format <= 10; ++format) {
      SCOPED_TRACE("1." + std::to_string(minor) + ", format " + std::to_string(format));
      LasFile las;
      las.minor = minor;
      las.format = format;
      las.points = points;
      las.extra = static_cast<std::size_t>(format % 3);
      if (format >= 6 && minor < 4) continue;  // formats 6 and up exist since version 1.4
      const bool colors = format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      expect_points(parse_point_cloud("c.las", las.bytes()), {colors, false});
    }
  }
}

TEST(CloudLas, ColoursOf8BitsAndNone) {
  LasFile las;
  las.points = points;
  las.color_factor = 1;
  expect_points(parse_point_cloud("c.las", las.bytes()), {true, false});
  las.color_factor = 0;
  expect_points(parse_point_cloud("c.las", las.bytes()), {false, false});
}

TEST(CloudLas, PointsThatAreWithheldAreLeftOut) {
  for (const int format : {3, 7}) {
    LasFile las;
    las.minor = 4;
    las.format = format;
    las.points = points;
    las.withheld = 1;
    const PointCloud cloud = parse_point_cloud("c.las", las.bytes());
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.colors.size(), 2U);
    EXPECT_NEAR(cloud.points[1].x(), 99.0F, 1e-5F);
  }
}

TEST(CloudLas, FaultsAreNamed) {
  LasFile las;
  las.points = points;
  const std::string good = las.bytes();
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string changed = good;
    return fault("c.las", changed.replace(at, bytes.size(), bytes));
  };
  EXPECT_EQ(with(104, "\x83"), "c.las: is compressed (LAZ); decompress it first, as with laszip or pdal translate");
  EXPECT_EQ(with(104, "\x0b"), "c.las: header: point format 11 is unknown");
  EXPECT_EQ(with(25, "\x05"), "c.las: header: LAS version 1.5 is unknown (1.0 to 1.4 are read)");
  EXPECT_EQ(with(105, little(std::uint16_t{33})),
            "c.las: header: a record of point format 3 has at least 34 bytes, here 33");
  EXPECT_EQ(with(131, little(0.0)), "c.las: header: a scale is zero or not finite");
  EXPECT_EQ(with(155, little(std::numeric_limits<double>::infinity())), "c.las: header: an offset is not finite");
  EXPECT_THAT(with(96, little(std::uint32_t{4000000000})), HasSubstr("points start at byte 4000000000"));
  EXPECT_THAT(with(96, little(std::uint32_t{100})), HasSubstr("points start at byte 100"));
  EXPECT_THAT(with(94, little(std::uint16_t{100})), HasSubstr("its own size is 100"));
  las.promised = 4000000000;
  EXPECT_EQ(fault("c.las", las.bytes()), "c.las: the header promises 4000000000 points, the file holds 3");
  las.minor = 4;
  las.promised = UINT64_MAX - 1;
  EXPECT_THAT(fault("c.las", las.bytes()), HasSubstr("the file holds 3"));
  EXPECT_EQ(fault("c.las", "LASF"), "c.las: ends within the header");
  EXPECT_EQ(fault("c.las", "hello"), "c.las: is not a LAS file");
}

TEST(CloudLas, FarCloudsAreRefusedAndReadInDoublePrecision) {
  LasFile las;
  las.offset = {500000.0, 5400000.0, 0.0};
  las.points = {{{500000.125, 5400000.377, 2.0}, {0, 0, 0}, {}}};
  EXPECT_EQ(fault("c.las", las.bytes()),
            "c.las: is too far from the origin: a point at 500000 5.4e+06 2 would move by 0.123 m in single precision; "
            "shift it with `odosplat cloud --from FILE --origin X Y Z`");
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  scan_cloud_bytes("c.las", las.bytes(), [&](const CloudBatch& batch) { point = batch.points.at(0); });
  EXPECT_NEAR((point - Eigen::Vector3d(500000.125, 5400000.377, 2.0)).norm(), 0.0, 1e-8);
  // Far from the origin, but exactly representable: not refused.
  EXPECT_EQ(parse_point_cloud("c.xyz", "5400000 0 0\n").points.at(0).x(), 5400000.0F);
}

TEST(CloudLas, EveryCutOfLasIsRefused) {
  LasFile las;
  las.points = points;
  const std::string bytes = las.bytes();
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    SCOPED_TRACE("cut at " + std::to_string(n));
    EXPECT_THROW(parse_point_cloud("c.las", bytes.substr(0, n)), InputError);
  }
}

}  // namespace
}  // namespace odosplat
