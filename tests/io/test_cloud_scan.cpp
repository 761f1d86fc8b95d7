// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud_scan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "cloud_bytes.hpp"
#include "odosplat/io/cloud_file.hpp"
#include "temp_folder.hpp"

namespace odosplat {
namespace {

using Eigen::Vector3f;
using test::error_of;
using test::FilePoint;
using test::LasFile;
using test::little;
using test::TempFolder;
using testing::HasSubstr;

const std::vector<FilePoint> points{{{101.5, 199.25, -3.125}, {255, 0, 51}, {0, 0, -1}},
                                    {{102.0, 198.0, 7.0}, {1, 2, 3}, {0.6F, 0.8F, 0}},
                                    {{99.0, 205.5, 0.0}, {128, 128, 128}, {1, 0, 0}}};

struct Parts {
  bool colors = true;
  bool normals = true;
};

void expect_points(const PointCloud& cloud, Parts parts) {
  ASSERT_EQ(cloud.size(), points.size());
  EXPECT_EQ(cloud.has_colors(), parts.colors);
  EXPECT_EQ(cloud.has_normals(), parts.normals);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (int a = 0; a < 3; ++a) {
      const auto at = static_cast<std::size_t>(a);
      EXPECT_NEAR(cloud.points[i][a], points[i].position[at], 1e-5);
      if (parts.colors) {
        EXPECT_NEAR(cloud.colors[i][a], static_cast<float>(points[i].color[at]) / 255.0F, 1e-6F);
      }
      if (parts.normals) {
        EXPECT_NEAR(cloud.normals[i][a], points[i].normal[at], 1e-6F);
      }
    }
  }
}

std::string fault(const std::string& name, const std::string& bytes) {
  return error_of([&] { parse_point_cloud(name, bytes); });
}

TEST(CloudScan, LasOfEveryVersionAndFormat) {
  for (int minor = 0; minor <= 4; ++minor) {
    for (int format = 0; format <= 10; ++format) {
      SCOPED_TRACE("1." + std::to_string(minor) + ", format " + std::to_string(format));
      LasFile las;
      las.minor = minor;
      las.format = format;
      las.points = points;
      las.extra = static_cast<std::size_t>(format % 3);
      if (format >= 6 && minor < 4) continue;  // formats 6 and up came with 1.4
      const bool colors = format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      expect_points(parse_point_cloud("c.las", las.bytes()), {colors, false});
    }
  }
}

TEST(CloudScan, LasColoursOf8BitsAndNone) {
  LasFile las;
  las.points = points;
  las.color_factor = 1;
  expect_points(parse_point_cloud("c.las", las.bytes()), {true, false});
  las.color_factor = 0;
  expect_points(parse_point_cloud("c.las", las.bytes()), {false, false});
}

TEST(CloudScan, LasPointsThatAreWithheldAreLeftOut) {
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

TEST(CloudScan, LasFaultsAreNamed) {
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

std::string ascii_pcd() {
  return test::pcd_header("x y z rgb normal_x normal_y normal_z", "4 8 4 4 4 4 4", "F F F U F F F", "1 1 1 1 1 1 1", 3,
                          "ascii") +
         "101.5 199.25 -3.125 16711731 0 0 -2\n102 198 7 66051 0.6 0.8 0\n\n99 205.5 0 8421504 1 0 0\n";
}

// x z of float, a field of 3 bytes, y of double, the packed colour, padding of 2 shorts, the normal.
const char* const mixed_fields = "x z id y rgba _ normal_x normal_y normal_z";
std::vector<std::string> mixed_columns(const FilePoint& p) {
  const auto rgba =
      static_cast<std::uint32_t>(0xff000000U | static_cast<unsigned>(p.color[0]) << 16 |
                                 static_cast<unsigned>(p.color[1]) << 8 | static_cast<unsigned>(p.color[2]));
  return {little(static_cast<float>(p.position[0])),
          little(static_cast<float>(p.position[2])),
          "abc",
          little(p.position[1]),
          little(rgba),
          "pads",
          little(p.normal[0]),
          little(p.normal[1]),
          little(p.normal[2])};
}

std::string mixed_header(const std::string& data) {
  return test::pcd_header(mixed_fields, "4 4 1 8 4 2 4 4 4", "F F U F U I F F F", "1 1 3 1 1 2 1 1 1", points.size(),
                          data);
}

std::string binary_pcd() {
  std::string bytes = mixed_header("binary");
  for (const FilePoint& p : points) {
    for (const std::string& value : mixed_columns(p)) bytes += value;
  }
  return bytes;
}

std::string compressed_pcd() {
  std::string columns;
  for (std::size_t field = 0; field < mixed_columns(points[0]).size(); ++field) {
    for (const FilePoint& p : points) columns += mixed_columns(p)[field];
  }
  return mixed_header("binary_compressed") + test::pcd_compressed(columns);
}

TEST(CloudScan, PcdOfEveryEncoding) {
  expect_points(parse_point_cloud("c.pcd", ascii_pcd()), {});
  expect_points(parse_point_cloud("c.pcd", binary_pcd()), {});
  expect_points(parse_point_cloud("c.pcd", compressed_pcd()), {});
  // The first bytes tell, whatever the file is called.
  expect_points(parse_point_cloud("c.dat", binary_pcd()), {});
}

TEST(CloudScan, PcdColoursOfEveryKind) {
  const auto color = [](const std::string& fields, const std::string& sizes, const std::string& types,
                        const std::string& row) {
    const std::string counts = fields.size() > 1 ? "1 1 1 1 1 1" : "1 1 1 1";
    const std::string text =
        test::pcd_header("x y z " + fields, "4 4 4 " + sizes, "F F F " + types, counts, 1, "ascii");
    return parse_point_cloud("c.pcd", text + "1 2 3 " + row + "\n").colors.at(0);
  };
  const Vector3f expected(1.0F, 0.0F, 0.2F);
  EXPECT_LT((color("r g b", "1 1 1", "U U U", "255 0 51") - expected).norm(), 1e-6F);
  EXPECT_LT((color("r g b", "2 2 2", "U U U", "65535 0 13107") - expected).norm(), 1e-6F);
  EXPECT_LT((color("r g b", "4 4 4", "F F F", "1 0 0.2") - expected).norm(), 1e-6F);
  EXPECT_LT((color("red green blue", "4 4 4", "F F F", "255 0 51") - expected).norm(), 1e-6F);
  // Packed into the bits of a float, printed as one: 0x00ff0033 is near the smallest normal number.
  const std::string header = test::pcd_header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, "ascii");
  EXPECT_LT((parse_point_cloud("c.pcd", header + "1 2 3 2.3418123e-38\n").colors.at(0) - expected).norm(), 1e-6F);
  EXPECT_EQ(parse_point_cloud("c.pcd", header + "1 2 3 nan\n").colors.at(0), Vector3f::Zero());
  const std::string integer = test::pcd_header("x y z rgba", "4 4 4 4", "F F F I", "1 1 1 1", 1, "ascii");
  EXPECT_LT((parse_point_cloud("c.pcd", integer + "1 2 3 -65485\n").colors.at(0) - expected).norm(), 1e-6F);
}

TEST(CloudScan, PcdOfOldVersionsLacksLines) {
  const std::string text =
      "VERSION .5\nCOLUMNS x y z\nWIDTH 2\nHEIGHT 2\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\nnan nan nan\n";
  EXPECT_EQ(parse_point_cloud("c.pcd", text).size(), 3U);
}

TEST(CloudScan, PcdIntegersOfEverySizeAreCoordinates) {
  const std::string header = test::pcd_header("x y z", "1 2 8", "I I I", "1 1 1", 1, "binary");
  const PointCloud a =
      parse_point_cloud("c.pcd", header + little(std::int8_t{-5}, std::int16_t{-300}, std::int64_t{-70000}));
  EXPECT_EQ(a.points.at(0), Vector3f(-5, -300, -70000));
  const std::string other = test::pcd_header("x y z", "1 2 4", "U U I", "1 1 1", 1, "binary");
  const PointCloud b =
      parse_point_cloud("c.pcd", other + little(std::uint8_t{200}, std::uint16_t{40000}, std::int32_t{-70000}));
  EXPECT_EQ(b.points.at(0), Vector3f(200, 40000, -70000));
}

TEST(CloudScan, PcdFaultsAreNamed) {
  const auto header = [](const std::string& key, const std::string& values) {
    std::string text = ascii_pcd();
    const std::size_t at = text.find("\n" + key) + 1;
    return fault("c.pcd", text.replace(at, text.find('\n', at) - at, key + " " + values));
  };
  EXPECT_EQ(header("SIZE", "4 4"), "c.pcd: line 4: SIZE has 2 values for 7 fields");
  EXPECT_EQ(header("SIZE", "4 4 4 4 4 4 3"), "c.pcd: line 4: size 3 is none of 1, 2, 4 and 8");
  EXPECT_EQ(header("SIZE", "4 4 4 2 4 4 4"), "c.pcd: header: packed colours have 4 bytes");
  EXPECT_EQ(header("SIZE", "2 4 4 4 4 4 4"), "c.pcd: header: a float has 4 or 8 bytes");
  EXPECT_EQ(header("TYPE", "F F F F F F X"), "c.pcd: line 5: type `X` is none of I, U and F");
  EXPECT_EQ(header("COUNT", "1 1 1 1 1 1 0"), "c.pcd: line 6: a count of 0 is out of range");
  EXPECT_EQ(header("COUNT", "1 1 1 1 1 1 9999999999"), "c.pcd: line 6: a count of 9999999999 is out of range");
  EXPECT_EQ(header("COUNT", "1 1 1 1 1 1 2"), "c.pcd: line 12: has 7 values, the header promises 8");
  EXPECT_EQ(header("POINTS", "many"), "c.pcd: line 10: `many` is not a whole number");
  EXPECT_EQ(header("POINTS", "7"), "c.pcd: the header promises 7 points, the file holds 3");
  EXPECT_EQ(header("DATA", "zip"), "c.pcd: line 11: data `zip` is none of ascii, binary and binary_compressed");
  EXPECT_EQ(header("FIELDS", "x y w rgb normal_x normal_y normal_z"), "c.pcd: header: has no fields x y z");
  EXPECT_EQ(header("WIDTH", ""), "c.pcd: line 7: WIDTH has no value");
  EXPECT_EQ(header("VIEWPOINT", "1\nWHAT 3"), "c.pcd: line 10: `WHAT` is not understood");
  EXPECT_EQ(fault("c.pcd", "# .PCD"), "c.pcd: is not a PCD file");
  EXPECT_EQ(fault("c.pcd", "VERSION .7\nDATA ascii\n"), "c.pcd: header: FIELDS is missing");
  EXPECT_EQ(fault("c.pcd", "VERSION .7\nFIELDS x y z\nDATA ascii\n"), "c.pcd: header: POINTS is missing");
  EXPECT_EQ(fault("c.pcd", "VERSION .7\nFIELDS x y z\nPOINTS 1\nDATA ascii\n1 two 3\n"),
            "c.pcd: line 5: `two` is not a number");
}

TEST(CloudScan, PcdPromisesAreNotTrusted) {
  std::string binary = binary_pcd();
  const std::size_t at = binary.find("POINTS 3") + 7;
  EXPECT_EQ(fault("c.pcd", binary.replace(at, 1, "99999999999999")),
            "c.pcd: the header promises 99999999999999 points, the file holds 3");
  std::string compressed = compressed_pcd();
  EXPECT_THAT(fault("c.pcd", compressed.replace(compressed.find("POINTS 3") + 7, 1, "4")),
              HasSubstr("the header promises 4 points, the file holds 3"));
  // Sizes that the data do not bear out.
  compressed = compressed_pcd();
  const std::size_t sizes = compressed.find("binary_compressed\n") + 18;
  std::string lying = compressed;
  EXPECT_THAT(fault("c.pcd", lying.replace(sizes, 4, little(std::uint32_t{0xffffffff}))), HasSubstr("promises 42949"));
  lying = compressed;
  lying.replace(lying.find("POINTS 3") + 7, 1, "90000000");
  lying.replace(lying.find("binary_compressed\n") + 22, 4, little(std::uint32_t{0xffffffff}));
  EXPECT_EQ(fault("c.pcd", lying), "c.pcd: the compressed data are broken or cut off");
  // A reference to what was before the start.
  std::string before = compressed;
  EXPECT_EQ(fault("c.pcd", before.replace(sizes + 8, 2, "\x3f\xff")),
            "c.pcd: the compressed data are broken or cut off");
}

TEST(CloudScan, PcdCompressedOfManyBatchesEqualsBinary) {
  std::string rows;
  std::array<std::string, 3> columns;
  const std::size_t n = 70000;  // more than a batch
  for (std::size_t i = 0; i < n; ++i) {
    // Runs, steps and a far echo: literals, short, long and farthest references.
    const float values[3] = {static_cast<float>(i / 500), static_cast<float>(i % 7), static_cast<float>(i % 2048)};
    for (std::size_t a = 0; a < 3; ++a) {
      rows += little(values[a]);
      columns[a] += little(values[a]);
    }
  }
  const auto header = [n](const std::string& data) {
    return test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", n, data);
  };
  // Every column alone, as references over a column's end are as good: all at once is slow in this compressor.
  std::string packed;
  for (const std::string& column : columns) packed += test::lzf_compress(column);
  const std::string compressed = header("binary_compressed") +
                                 little(static_cast<std::uint32_t>(packed.size()), static_cast<std::uint32_t>(12 * n)) +
                                 packed;
  EXPECT_LT(packed.size(), rows.size() / 10);
  const PointCloud a = parse_point_cloud("c.pcd", header("binary") + rows);
  const PointCloud b = parse_point_cloud("c.pcd", compressed);
  ASSERT_EQ(a.size(), n);
  EXPECT_EQ(a.points, b.points);
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

TEST(CloudScan, EveryCutIsReadOrRefused) {
  LasFile las;
  las.points = points;
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"c.las", las.bytes()},
                                    {"c.pcd", ascii_pcd()},
                                    {"b.pcd", binary_pcd()},
                                    {"z.pcd", compressed_pcd()}}) {
    for (std::size_t n = 0; n + 7 < bytes.size(); ++n) {
      SCOPED_TRACE(name + " cut at " + std::to_string(n));
      EXPECT_THROW(parse_point_cloud(name, bytes.substr(0, n)), InputError);
    }
  }
}

TEST(CloudScan, FarCloudsAreRefusedAndReadInDoublePrecision) {
  LasFile las;
  las.offset = {500000.0, 5400000.0, 0.0};
  las.points = {{{500000.125, 5400000.377, 2.0}, {0, 0, 0}, {}}};
  EXPECT_EQ(fault("c.las", las.bytes()),
            "c.las: is too far from the origin: a point at 500000 5.4e+06 2 would move by 0.123 m in single precision; "
            "bring it near with `odosplat cloud --from FILE --origin X Y Z`");
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  scan_cloud_bytes("c.las", las.bytes(), [&](const CloudBatch& batch) { point = batch.points.at(0); });
  EXPECT_NEAR((point - Eigen::Vector3d(500000.125, 5400000.377, 2.0)).norm(), 0.0, 1e-8);
  // Far, but what the file says is kept: no reason to refuse.
  EXPECT_EQ(parse_point_cloud("c.xyz", "5400000 0 0\n").points.at(0).x(), 5400000.0F);
}

TEST(CloudScan, UnknownFilesAreRefused) {
  const TempFolder temp;
  EXPECT_EQ(fault("c.bin", "1 2 3\n"),
            "c.bin: is no point cloud of a known format (PLY, PCD, LAS, or text as .xyz .csv .txt)");
  EXPECT_EQ(fault("c", ""), "c: is no point cloud of a known format (PLY, PCD, LAS, or text as .xyz .csv .txt)");
  EXPECT_EQ(error_of([] { scan_cloud("/nowhere.xyz", [](const CloudBatch&) {}); }), "/nowhere.xyz: is missing");
  EXPECT_EQ(error_of([&] { scan_cloud(temp.path(), [](const CloudBatch&) {}); }), temp.path() + ": is not a file");
}

}  // namespace
}  // namespace odosplat
