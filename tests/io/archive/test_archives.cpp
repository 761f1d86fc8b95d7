// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <functional>

#include "odosplat/core/error.hpp"
#include "odosplat/io/archive/compression.hpp"
#include "odosplat/io/archive/zip_archive.hpp"
#include "tests/splat/format/zip_bytes.hpp"

namespace odosplat {
namespace {

using test::fault_of;
using test::little;
using testing::HasSubstr;

std::string text(std::size_t size) {
  std::string bytes;
  while (bytes.size() < size) bytes += std::to_string(bytes.size() * bytes.size() % 9973) + " ";
  bytes.resize(size);
  return bytes;
}

TEST(Compression, ComesBackTheSame) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{100}, std::size_t{3'000'000}}) {
    const std::string content = text(size);
    EXPECT_EQ(zstd_decompressed("f", "p", zstd_compressed(content), size), content);
    EXPECT_EQ(inflated("f", "p", test::deflated(content, -15), size), content);
    const std::string gzip = test::gzip(content);
    GzipStream stream("f", gzip);
    const std::string first = stream.read(size / 3);
    EXPECT_EQ(first + stream.read(size - size / 3), content);
  }
  EXPECT_EQ(zstd_compressed(text(500000)), zstd_compressed(text(500000)));
}

TEST(Compression, WrongSizesAndCutsAreNamed) {
  const std::string content = text(5000);
  const std::string zstd = zstd_compressed(content);
  const std::string deflate = test::deflated(content, -15);
  for (const std::size_t size : {std::size_t{0}, std::size_t{4999}, std::size_t{5001}}) {
    EXPECT_THAT(fault_of([&] { zstd_decompressed("f", "p", zstd, size); }), HasSubstr("f: p: is damaged")) << size;
    EXPECT_THAT(fault_of([&] { inflated("f", "p", deflate, size); }), HasSubstr("f: p: is damaged")) << size;
  }
  for (std::size_t n = 0; n < zstd.size(); n += 11) {
    EXPECT_NE(fault_of([&] { zstd_decompressed("f", "p", zstd.substr(0, n), 5000); }), "") << n;
  }
  for (std::size_t n = 0; n < deflate.size(); n += 11) {
    EXPECT_NE(fault_of([&] { inflated("f", "p", deflate.substr(0, n), 5000); }), "") << n;
  }
  EXPECT_EQ(fault_of([&] { GzipStream("f", test::gzip(content)).read(5001); }),
            "f: is cut off: its compressed data end too early");
  EXPECT_THAT(fault_of([&] { GzipStream("f", "no gzip").read(1); }), HasSubstr("is cut off or damaged"));
}

TEST(Compression, SizesThatAFileCannotHoldAreRefused) {
  EXPECT_EQ(fault_of([] { require_plausible_size("f", 128 * 100, 100); }), "");
  EXPECT_THAT(fault_of([] { require_plausible_size("f", 128 * 101 + 1, 100); }),
              HasSubstr("f: declares 12929 bytes of data, more than its 100 bytes can hold"));
}

TEST(ZipArchive, MembersAreRead) {
  for (const bool compress : {false, true}) {
    const std::string bytes = test::zip_bytes({{"a", text(1000)}, {"b/c", ""}}, compress);
    const ZipArchive zip("f", bytes);
    EXPECT_TRUE(zip.has("a"));
    EXPECT_FALSE(zip.has("c"));
    EXPECT_EQ(zip.read("a", 1000), text(1000));
    EXPECT_EQ(zip.read("b/c", 0), "");
    EXPECT_THAT(fault_of([&] { zip.read("a", 999); }), HasSubstr("`a`: has 1000 bytes, over the limit of 999"));
    EXPECT_THAT(fault_of([&] { zip.read("c", 999); }), HasSubstr("f: `c`: is missing in the archive"));
  }
}

TEST(ZipArchive, FaultsAreNamed) {
  const std::string good = test::zip_bytes({{"a", text(100)}}, true);
  for (std::size_t n = 0; n < good.size(); ++n) {
    EXPECT_NE(fault_of([&] { ZipArchive("f", good.substr(0, n)); }), "") << n;
  }
  const std::size_t entry = good.find("PK\x01\x02");
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string wrong = good;
    wrong.replace(at, bytes.size(), bytes);
    return fault_of([&] { ZipArchive("f", wrong).read("a", 1000); });
  };
  EXPECT_EQ(with(0, ""), "");
  EXPECT_THAT(with(entry + 8, little<std::uint16_t>(1)), HasSubstr("`a`: is encrypted"));
  EXPECT_THAT(with(entry + 10, little<std::uint16_t>(12)), HasSubstr("is compressed by method 12"));
  EXPECT_THAT(with(entry + 16, little<std::uint32_t>(1)), HasSubstr("its checksum is wrong"));
  EXPECT_THAT(with(entry + 20, little<std::uint32_t>(1U << 30U)), HasSubstr("`a`: is cut off"));
  EXPECT_THAT(with(entry + 24, little<std::uint32_t>(99)), HasSubstr("not of the declared size"));
  EXPECT_THAT(with(entry + 42, little<std::uint32_t>(5)), HasSubstr("it is not where the directory says"));
  EXPECT_THAT(with(entry + 42, little<std::uint32_t>(0xFFFFFFF0U)), HasSubstr("it is not where the directory says"));
  EXPECT_THAT(with(entry, "XX"), HasSubstr("the directory of the ZIP archive is broken"));
  EXPECT_THAT(with(entry + 28, little<std::uint16_t>(9999)), HasSubstr("is cut off"));
  EXPECT_THAT(fault_of([] {
                ZipArchive("f", test::zip_bytes({{"a", "1"}, {"a", "2"}}));
              }),
              HasSubstr("`a`: comes twice"));
}

}  // namespace
}  // namespace odosplat
