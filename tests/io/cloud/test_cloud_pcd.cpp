// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>

#include "tests/io/cloud/cloud_checks.hpp"
#include "tests/locations.hpp"

namespace odosplat {
namespace {

using Eigen::Vector3f;
using test::expect_points;
using test::fault;
using test::FilePoint;
using test::little;
using test::points;
using testing::HasSubstr;

std::string ascii_pcd() {
  return test::pcd_header("x y z rgb normal_x normal_y normal_z", "4 8 4 4 4 4 4", "F F F U F F F", "1 1 1 1 1 1 1", 3,
                          "ascii") +
         "101.5 199.25 -3.125 16711731 0 0 -2\n102 198 7 66051 0.6 0.8 0\n\n99 205.5 0 8421504 1 0 0\n";
}

// x and z as float, a field of 3 bytes, y as double, the packed colour, padding of 2 shorts, the normal.
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

TEST(CloudPcd, OfEveryEncoding) {
  expect_points(parse_point_cloud("c.pcd", ascii_pcd()), {});
  expect_points(parse_point_cloud("c.pcd", binary_pcd()), {});
  expect_points(parse_point_cloud("c.pcd", compressed_pcd()), {});
  // The format is recognised by the first bytes, not by the name.
  expect_points(parse_point_cloud("c.dat", binary_pcd()), {});
}

// Data compressed by the public LZF library (liblzf through python-lzf), not by the compressor of these tests.
TEST(CloudPcd, CompressedByOthersIsRead) {
  const std::string corpus = test::source_dir() + "/tests/fuzz/corpus/pcd/";
  const PointCloud plain = read_point_cloud(corpus + "binary.pcd");
  const PointCloud packed = read_point_cloud(corpus + "compressed.pcd");
  ASSERT_EQ(plain.size(), 40U);
  EXPECT_EQ(packed.points, plain.points);
  EXPECT_EQ(packed.colors, plain.colors);
  EXPECT_EQ(packed.normals, plain.normals);
}

TEST(CloudPcd, ColoursOfEveryKind) {
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
  EXPECT_LT((color("Red Green Blue", "2 2 2", "U U U", "255 0 51") - expected).norm(), 1e-6F);
  EXPECT_LT((color("r g b", "4 4 4", "U U U", "65535 0 13107") - expected).norm(), 1e-6F);
  EXPECT_LT((color("r g b", "4 4 4", "F F F", "65535 0 13107") - expected).norm(), 1e-6F);
  EXPECT_LT((color("r g b", "4 4 4", "F F F", "1 0 0.2") - expected).norm(), 1e-6F);
  EXPECT_LT((color("red green blue", "4 4 4", "F F F", "255 0 51") - expected).norm(), 1e-6F);
  // A colour packed into the bits of a float and printed as a number: 0x00ff0033 is near the smallest normal number.
  const std::string header = test::pcd_header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, "ascii");
  EXPECT_LT((parse_point_cloud("c.pcd", header + "1 2 3 2.3418123e-38\n").colors.at(0) - expected).norm(), 1e-6F);
  EXPECT_EQ(parse_point_cloud("c.pcd", header + "1 2 3 nan\n").colors.at(0), Vector3f::Zero());
  const std::string integer = test::pcd_header("x y z rgba", "4 4 4 4", "F F F I", "1 1 1 1", 1, "ascii");
  EXPECT_LT((parse_point_cloud("c.pcd", integer + "1 2 3 -65485\n").colors.at(0) - expected).norm(), 1e-6F);
}

TEST(CloudPcd, NamesOfFieldsMayBeInAnyCase) {
  const std::string header = test::pcd_header("X Y Z RGB NormalX NormalY NormalZ", "4 4 4 4 4 4 4", "F F F U F F F",
                                              "1 1 1 1 1 1 1", 1, "ascii");
  const PointCloud cloud = parse_point_cloud("c.pcd", "\xEF\xBB\xBF" + header + "1 2 3 16711731 0 0 2\n");
  EXPECT_EQ(cloud.points.at(0), Vector3f(1, 2, 3));
  EXPECT_LT((cloud.colors.at(0) - Vector3f(1.0F, 0.0F, 0.2F)).norm(), 1e-6F);
  EXPECT_EQ(cloud.normals.at(0), Vector3f(0, 0, 1));
}

TEST(CloudPcd, OfOldVersionsLacksLines) {
  const std::string text =
      "VERSION .5\nCOLUMNS x y z\nWIDTH 2\nHEIGHT 2\nDATA ascii\n1 2 3\n4 5 6\n7 8 9\nnan nan nan\n";
  EXPECT_EQ(parse_point_cloud("c.pcd", text).size(), 3U);
}

TEST(CloudPcd, IntegersOfEverySizeAreCoordinates) {
  const std::string header = test::pcd_header("x y z", "1 2 8", "I I I", "1 1 1", 1, "binary");
  const PointCloud a =
      parse_point_cloud("c.pcd", header + little(std::int8_t{-5}, std::int16_t{-300}, std::int64_t{-70000}));
  EXPECT_EQ(a.points.at(0), Vector3f(-5, -300, -70000));
  const std::string other = test::pcd_header("x y z", "1 2 4", "U U I", "1 1 1", 1, "binary");
  const PointCloud b =
      parse_point_cloud("c.pcd", other + little(std::uint8_t{200}, std::uint16_t{40000}, std::int32_t{-70000}));
  EXPECT_EQ(b.points.at(0), Vector3f(200, 40000, -70000));
}

TEST(CloudPcd, FaultsAreNamed) {
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
  EXPECT_EQ(header("POINTS", "7"), "c.pcd: header: POINTS is 7, WIDTH times HEIGHT is 3");
  EXPECT_EQ(header("HEIGHT", "18446744073709551615"), "c.pcd: header: WIDTH is out of range");
  // 2^63 times 2 overflows to 0 in 64 bits.
  EXPECT_EQ(fault("c.pcd", "VERSION .7\nFIELDS x y z\nWIDTH 9223372036854775808\nHEIGHT 2\nPOINTS 0\nDATA ascii\n"),
            "c.pcd: header: WIDTH is out of range");
  EXPECT_EQ(header("VIEWPOINT", "1\nPOINTS 3"), "c.pcd: line 11: POINTS comes twice");
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

TEST(CloudPcd, PromisesAreNotTrusted) {
  const auto promising = [](std::string bytes, const std::string& promised) {
    bytes.replace(bytes.find("POINTS 3") + 7, 1, promised);
    return bytes.replace(bytes.find("WIDTH 3") + 6, 1, promised);
  };
  EXPECT_EQ(fault("c.pcd", promising(binary_pcd(), "99999999999999")),
            "c.pcd: the header promises 99999999999999 points, the file holds 3");
  EXPECT_EQ(fault("c.pcd", promising(ascii_pcd(), "7")), "c.pcd: the header promises 7 points, the file holds 3");
  EXPECT_THAT(fault("c.pcd", promising(compressed_pcd(), "4")),
              HasSubstr("the header promises 4 points, the file holds 3"));
  // Sizes that do not match the data.
  const std::string compressed = compressed_pcd();
  const std::size_t sizes = compressed.find("binary_compressed\n") + 18;
  std::string lying = compressed;
  EXPECT_THAT(fault("c.pcd", lying.replace(sizes, 4, little(std::uint32_t{0xffffffff}))), HasSubstr("promises 42949"));
  lying = promising(compressed, "90000000");
  lying.replace(lying.find("binary_compressed\n") + 22, 4, little(std::uint32_t{0xffffffff}));
  EXPECT_EQ(fault("c.pcd", lying), "c.pcd: the compressed data are broken or cut off");
  // A reference to a position before the start.
  std::string before = compressed;
  EXPECT_EQ(fault("c.pcd", before.replace(sizes + 8, 2, "\x3f\xff")),
            "c.pcd: the compressed data are broken or cut off");
}

TEST(CloudPcd, CompressedOfManyBatchesEqualsBinary) {
  std::string rows;
  std::array<std::string, 3> columns;
  const std::size_t n = 70000;  // more than one batch
  for (std::size_t i = 0; i < n; ++i) {
    // Long runs, short steps and a distant repetition, which give literals, short, long and the farthest references.
    const float values[3] = {static_cast<float>(i / 500), static_cast<float>(i % 7), static_cast<float>(i % 2048)};
    for (std::size_t a = 0; a < 3; ++a) {
      rows += little(values[a]);
      columns[a] += little(values[a]);
    }
  }
  const auto header = [n](const std::string& data) {
    return test::pcd_header("x y z", "4 4 4", "F F F", "1 1 1", n, data);
  };
  // Each column is compressed separately, which is also valid: this compressor would be slow on all at once.
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

TEST(CloudPcd, EveryCutOfPcdIsRefused) {
  // The last bytes of the text are blanks and digits, and those of the compressed columns belong to a field that is not
  // read.
  for (const std::string& bytes : {ascii_pcd(), binary_pcd(), compressed_pcd()}) {
    for (std::size_t n = 0; n + 7 < bytes.size(); ++n) {
      SCOPED_TRACE("cut at " + std::to_string(n));
      EXPECT_THROW(parse_point_cloud("c.pcd", bytes.substr(0, n)), InputError);
    }
  }
}

}  // namespace
}  // namespace odosplat
