// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/cloud/ply.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::ElementsAre;
using testing::HasSubstr;

template <typename T>
std::string bytes_of(T value, bool big) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  if (big) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string header(const std::string& format, const std::string& elements) {
  return "ply\nformat " + format + " 1.0\ncomment made by hand\nobj_info as well\n" + elements + "end_header\n";
}

const std::string every_type =
    "element vertex 2\nproperty char a\nproperty uchar b\nproperty short c\nproperty ushort d\n"
    "property int e\nproperty uint f\nproperty float g\nproperty double h\n";

std::string binary_row(bool big, int k) {
  return bytes_of(static_cast<std::int8_t>(-1 - k), big) + bytes_of(static_cast<std::uint8_t>(250 + k), big) +
         bytes_of(static_cast<std::int16_t>(-300 - k), big) + bytes_of(static_cast<std::uint16_t>(65000 + k), big) +
         bytes_of(static_cast<std::int32_t>(-70000 - k), big) + bytes_of(4000000000U + static_cast<unsigned>(k), big) +
         bytes_of(1.5F + static_cast<float>(k), big) + bytes_of(-2.25 - k, big);
}

void expect_every_type(const Ply& ply) {
  const PlyElement& v = ply.element("vertex");
  EXPECT_EQ(v.count, 2U);
  EXPECT_THAT(std::get<std::vector<std::int8_t>>(*v.find("a")), ElementsAre(-1, -2));
  EXPECT_THAT(std::get<std::vector<std::uint8_t>>(*v.find("b")), ElementsAre(250, 251));
  EXPECT_THAT(std::get<std::vector<std::int16_t>>(*v.find("c")), ElementsAre(-300, -301));
  EXPECT_THAT(std::get<std::vector<std::uint16_t>>(*v.find("d")), ElementsAre(65000, 65001));
  EXPECT_THAT(std::get<std::vector<std::int32_t>>(*v.find("e")), ElementsAre(-70000, -70001));
  EXPECT_THAT(std::get<std::vector<std::uint32_t>>(*v.find("f")), ElementsAre(4000000000U, 4000000001U));
  EXPECT_THAT(std::get<std::vector<float>>(*v.find("g")), ElementsAre(1.5F, 2.5F));
  EXPECT_THAT(std::get<std::vector<double>>(*v.find("h")), ElementsAre(-2.25, -3.25));
  EXPECT_THAT(ply.column<double>("vertex", "d"), ElementsAre(65000.0, 65001.0));
  EXPECT_THAT(ply.comments, ElementsAre("made by hand", "as well"));
}

TEST(Ply, ReadsEveryTypeInEveryFormat) {
  for (const bool big : {false, true}) {
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    expect_every_type(parse_ply("p", header(format, every_type) + binary_row(big, 0) + binary_row(big, 1)));
  }
  expect_every_type(parse_ply("p", header("ascii", every_type) +
                                       "-1 250 -300 65000 -70000 4000000000 1.5 -2.25\n"
                                       "\n  -2 251 -301 65001 -70001 4000000001 +2.5 -3.25 \r\n"));
}

TEST(Ply, SizedTypeNamesMeanTheSame) {
  std::string elements = every_type;
  const std::vector<std::pair<std::string, std::string>> names{
      {"property char", "property int8"},     {"property uchar", "property uint8"},
      {"property short", "property int16"},   {"property ushort", "property uint16"},
      {"property int e", "property int32 e"}, {"property uint f", "property uint32 f"},
      {"property float", "property float32"}, {"property double", "property float64"}};
  for (const auto& [usual, sized] : names) elements.replace(elements.find(usual), usual.size(), sized);
  expect_every_type(
      parse_ply("p", header("binary_little_endian", elements) + binary_row(false, 0) + binary_row(false, 1)));
}

TEST(Ply, CarriageReturnsInTheHeaderAreNoContent) {
  std::string text = header("binary_little_endian", every_type);
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
  expect_every_type(parse_ply("p", text + binary_row(false, 0) + binary_row(false, 1)));
}

TEST(Ply, ListsAreReadPast) {
  const std::string elements =
      "element face 2\nproperty uchar flag\nproperty list uchar int vertex_indices\nproperty short mark\n"
      "element vertex 1\nproperty float x\n";
  for (const bool big : {false, true}) {
    std::string body;
    for (int face = 0; face < 2; ++face) {
      body += bytes_of(static_cast<std::uint8_t>(7 + face), big) + bytes_of(static_cast<std::uint8_t>(3 * face), big);
      for (int i = 0; i < 3 * face; ++i) body += bytes_of(i, big);
      body += bytes_of(static_cast<std::int16_t>(-face), big);
    }
    body += bytes_of(4.5F, big);
    const Ply ply = parse_ply("p", header(big ? "binary_big_endian" : "binary_little_endian", elements) + body);
    EXPECT_THAT(ply.column<int>("face", "flag"), ElementsAre(7, 8));
    EXPECT_THAT(ply.column<int>("face", "mark"), ElementsAre(0, -1));
    EXPECT_FALSE(ply.element("face").has("vertex_indices"));
    EXPECT_THAT(ply.column<float>("vertex", "x"), ElementsAre(4.5F));
  }
  const Ply ascii = parse_ply("p", header("ascii", elements) + "7 0 0\n8 3 0 1 2 -1\n4.5\n");
  EXPECT_THAT(ascii.column<int>("face", "mark"), ElementsAre(0, -1));
  EXPECT_THAT(ascii.column<float>("vertex", "x"), ElementsAre(4.5F));
}

TEST(Ply, RoundTripKeepsBits) {
  const TempFolder temp;
  Ply ply;
  ply.comments = {"first", "second: 1 2 3"};
  PlyElement vertex;
  vertex.name = "vertex";
  const std::size_t n = 40000;  // several blocks
  std::vector<float> x(n);
  std::vector<std::uint8_t> r(n);
  std::vector<double> d(n);
  std::vector<std::int16_t> s(n);
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = std::sin(static_cast<float>(i));
    r[i] = static_cast<std::uint8_t>(i * 7);
    d[i] = 1.0 / (1.0 + static_cast<double>(i));
    s[i] = static_cast<std::int16_t>(i);
  }
  x[5] = std::numeric_limits<float>::infinity();
  vertex.add("x", x);
  vertex.add("red", r);
  vertex.add("d", d);
  vertex.add("s", s);
  ply.elements.push_back(vertex);
  PlyElement none;
  none.name = "none";
  none.add("y", std::vector<float>());
  ply.elements.push_back(none);
  write_ply(temp / "a.ply", ply);
  const Ply read = read_ply(temp / "a.ply");
  EXPECT_EQ(read.comments, ply.comments);
  ASSERT_EQ(read.elements.size(), 2U);
  EXPECT_EQ(read.column<float>("vertex", "x"), x);
  EXPECT_EQ(read.column<std::uint8_t>("vertex", "red"), r);
  EXPECT_EQ(read.column<double>("vertex", "d"), d);
  EXPECT_EQ(read.column<std::int16_t>("vertex", "s"), s);
  EXPECT_EQ(read.element("none").count, 0U);
  write_ply(temp / "b.ply", read);
  EXPECT_EQ(read_file(temp / "a.ply"), read_file(temp / "b.ply"));
}

TEST(Ply, ColumnsOfUnequalLengthAreTheProgrammersFault) {
  PlyElement vertex;
  vertex.add("x", std::vector<float>(3));
  EXPECT_THROW(vertex.add("y", std::vector<float>(4)), std::invalid_argument);
  const TempFolder temp;
  Ply ply;
  ply.elements.push_back(vertex);  // no name
  EXPECT_THROW(write_ply(temp / "p.ply", ply), std::invalid_argument);
  EXPECT_THAT(temp.files(), testing::IsEmpty());
}

TEST(Ply, MissingPartsAreNamed) {
  const Ply ply = parse_ply("p.ply", header("ascii", "element vertex 1\nproperty float x\n") + "1\n");
  EXPECT_EQ(error_of([&] { ply.column<float>("vertex", "y"); }), "p.ply: vertex: has no property y");
  EXPECT_EQ(error_of([&] { ply.column<float>("face", "y"); }), "p.ply: has no element face");
  EXPECT_EQ(error_of([] { read_ply("/nowhere.ply"); }), "/nowhere.ply: is missing");
  const TempFolder temp;
  EXPECT_EQ(error_of([&] { read_ply(temp.path()); }), temp.path() + ": is not a regular file but a folder");
}

TEST(Ply, SaysHowManyRowsATruncatedFileHolds) {
  const std::string elements = "element vertex 100\nproperty float x\nproperty uchar r\n";
  std::string body;
  for (int i = 0; i < 100; ++i) body += bytes_of(static_cast<float>(i), false) + "r";
  const std::string whole = header("binary_little_endian", elements) + body;
  EXPECT_EQ(parse_ply("p", whole).element("vertex").count, 100U);
  const std::size_t start = whole.size() - body.size();
  for (std::size_t length = start; length < whole.size(); ++length) {
    EXPECT_EQ(error_of([&] { parse_ply("p", whole.substr(0, length)); }),
              "p: the header promises 100 rows of vertex, the file holds " + std::to_string((length - start) / 5));
  }
  for (std::size_t length = 0; length < start; ++length) {
    EXPECT_THAT(error_of([&] { parse_ply("p", whole.substr(0, length)); }), testing::StartsWith("p: ")) << length;
  }
}

TEST(Ply, TruncatedAsciiAndListsAreErrorsAtEveryLength) {
  const std::string elements = "element vertex 3\nproperty float x\nproperty list uchar uchar l\n";
  const std::string ascii = header("ascii", elements) + "1 2 3 4\n2 0\n3 1 9";
  EXPECT_EQ(parse_ply("p", ascii).element("vertex").count, 3U);
  for (std::size_t length = 0; length < ascii.size(); ++length) {
    EXPECT_THROW(parse_ply("p", ascii.substr(0, length)), InputError) << length;
  }
  EXPECT_EQ(error_of([&] { parse_ply("p", ascii.substr(0, ascii.rfind('\n') + 1)); }),
            "p: the header promises 3 rows of vertex, the file holds 2");
  std::string binary = header("binary_big_endian", elements);
  for (int i = 0; i < 3; ++i) binary += bytes_of(1.0F, true) + std::string("\x02") + "ab";
  EXPECT_EQ(parse_ply("p", binary).element("vertex").count, 3U);
  for (std::size_t length = 0; length < binary.size(); ++length) {
    EXPECT_THROW(parse_ply("p", binary.substr(0, length)), InputError) << length;
  }
}

// Memory is allocated only for what the file can contain: these headers state exabytes.
TEST(Ply, OverPromisingHeadersTakeNoMemory) {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* properties : {"property double x\n", "property list uint double l\n"}) {
      const std::string text =
          header(format, std::string("element vertex 18446744073709551615\n") + properties) + std::string(8, '\0');
      EXPECT_THAT(error_of([&] { parse_ply("p", text); }), testing::StartsWith("p: ")) << format << properties;
    }
    const std::string no_properties = header(format, "element vertex 18446744073709551615\n");
    EXPECT_EQ(parse_ply("p", no_properties).element("vertex").count, 0U);
  }
  const std::string long_list = header("binary_little_endian", "element f 1\nproperty list uint double l\n") +
                                bytes_of(std::uint32_t{4294967295U}, false) + "12345678";
  EXPECT_EQ(error_of([&] { parse_ply("p", long_list); }), "p: the header promises 1 rows of f, the file holds 0");
}

struct Fault {
  std::string text;
  std::string message;
};

class PlyFault : public testing::TestWithParam<Fault> {};

TEST_P(PlyFault, IsNamed) {
  EXPECT_EQ(error_of([] { parse_ply("p", GetParam().text); }), GetParam().message);
}

INSTANTIATE_TEST_SUITE_P(
    All, PlyFault,
    testing::Values(
        Fault{"", "p: is not a PLY file"}, Fault{"PLY\n", "p: is not a PLY file"},
        Fault{std::string(100000, 'x'), "p: is not a PLY file"},
        Fault{"ply\nend_header\n", "p: the header names no format"},
        Fault{"ply\nformat text 1.0\nend_header\n", "p: line 2: unknown format `text`"},
        Fault{"ply\nformat ascii 2.0\nend_header\n", "p: line 2: unknown version `2.0`"},
        Fault{header("ascii", "colour red\n"), "p: line 5: `colour` is not understood"},
        Fault{header("ascii", "property float x\n"), "p: line 5: property before any element"},
        Fault{header("ascii", "element vertex\n"), "p: line 5: `` is not a number of rows"},
        Fault{header("ascii", "element vertex -1\n"), "p: line 5: `-1` is not a number of rows"},
        Fault{header("ascii", "element vertex 1e3\n"), "p: line 5: `1e3` is not a number of rows"},
        Fault{header("ascii", "element v 1\nproperty real x\n"), "p: line 6: unknown type `real`"},
        Fault{header("ascii", "element v 1\nproperty float\n"), "p: line 6: property without a name"},
        Fault{header("ascii", "element v 1\nproperty list float int x\n"),
              "p: line 6: the length of a list must be a whole number"},
        Fault{header("ascii", "element v 0\nelement v 0\n"), "p: line 6: element v comes twice"},
        Fault{header("ascii", "element v 1\nproperty int x\nproperty int x\n"), "p: line 7: property x comes twice"},
        Fault{header("ascii", "element v 2\nproperty float x\n") + "1\ntwo\n", "p: line 9: `two` is not a number"},
        Fault{header("ascii", "element v 1\nproperty uchar x\n") + "256\n", "p: line 8: a value does not fit its type"},
        Fault{header("ascii", "element v 1\nproperty int x\n") + "1.5\n", "p: line 8: a value does not fit its type"},
        Fault{header("ascii", "element v 1\nproperty int x\n") + "nan\n", "p: line 8: a value does not fit its type"},
        Fault{header("ascii", "element v 1\nproperty float x\nproperty float y\n") + "1\n",
              "p: line 9: has fewer values than the header promises"},
        Fault{header("ascii", "element v 1\nproperty float x\n") + "1 2\n",
              "p: line 8: has more values than the header promises"},
        Fault{header("binary_little_endian", "element f 1\nproperty list char int l\n") + "\xff",
              "p: row 1: a list has a negative length"}));

TEST(Ply, NotANumberIsKept) {
  const Ply ply = parse_ply("p", header("ascii", "element v 3\nproperty float x\n") + "nan\n-inf\n1e300\n");
  const std::vector<float> x = ply.column<float>("v", "x");
  EXPECT_TRUE(std::isnan(x[0]));
  EXPECT_EQ(x[1], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(x[2], std::numeric_limits<float>::infinity());
}

TEST(Ply, UnwritablePlaceLeavesNothing) {
  const TempFolder temp;
  const std::string file = temp.put("file", "");
  EXPECT_THAT(error_of([&] { write_ply(file + "/p.ply", {}); }), HasSubstr("cannot be written"));
  EXPECT_THAT(temp.files(), ElementsAre("file"));
}

}  // namespace
}  // namespace odosplat
