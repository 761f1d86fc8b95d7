// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/splat/format/sog.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/splat/format/made_map.hpp"
#include "tests/splat/format/zip_bytes.hpp"

namespace odosplat {
namespace {

using Json = nlohmann::json;
using test::fault_of;
using testing::HasSubstr;

std::string webp(const cv::Mat4b& rgba, int quality = 101) {  // above 100: lossless
  cv::Mat bgra;
  cv::cvtColor(rgba, bgra, cv::COLOR_RGBA2BGRA);
  std::vector<unsigned char> bytes;
  cv::imencode(".webp", bgra, bytes, {cv::IMWRITE_WEBP_QUALITY, quality});
  return {bytes.begin(), bytes.end()};
}

/// A map of `count` Gaussians whose values are picked so that the format holds them exactly, and its files.
struct MadeSog {
  Json meta;
  std::map<std::string, std::string> files;
  Gaussians wanted;

  MadeSog(int version, int degree, int count, cv::Size size) {
    const auto n = static_cast<std::size_t>(count);
    wanted = test::made_gaussians(degree, n);
    std::map<std::string, cv::Mat4b> images;
    for (const char* name : {"means_l", "means_u", "quats", "scales", "sh0", "shN_labels"}) {
      images[name] = cv::Mat4b(size, cv::Vec4b(0, 0, 0, 255));
    }
    const std::vector<double> least{-2, -1, 0.5};
    const std::vector<double> most{1, 2, 3};
    const auto rest = static_cast<std::size_t>(wanted.coefficients() - 1);
    const int sets = 70;  // more than a row of the image
    cv::Mat4b centroids(2, static_cast<int>(64 * std::max<std::size_t>(rest, 1)), cv::Vec4b(0, 0, 0, 255));
    for (int y = 0; y < centroids.rows; ++y) {
      for (int x = 0; x < centroids.cols; ++x) {
        for (int c = 0; c < 3; ++c) centroids(y, x)[c] = static_cast<unsigned char>((7 * x + 31 * y + 80 * c) % 256);
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      const auto pixel = [&](const char* name) -> cv::Vec4b& {
        return images[name](static_cast<int>(i) / size.width, static_cast<int>(i) % size.width);
      };
      for (int a = 0; a < 3; ++a) {
        const auto at = static_cast<std::size_t>(a);
        const int value = static_cast<int>((i * 977 + at * 20011) % 65536);
        pixel("means_l")[a] = static_cast<unsigned char>(value % 256);
        pixel("means_u")[a] = static_cast<unsigned char>(value / 256);
        const double l = least[at] + (most[at] - least[at]) * value / 65535.0;
        wanted.positions[3 * i + at] = static_cast<float>(l < 0 ? 1 - std::exp(-l) : std::exp(l) - 1);
        const int byte = static_cast<int>((i * 13 + at * 50) % 256);
        pixel("scales")[a] = pixel("sh0")[a] = static_cast<unsigned char>(byte);
        wanted.log_scales[3 * i + at] = static_cast<float>(-8.0 + 6.0 * byte / 255.0);
        wanted.sh[3 * (rest + 1) * i + at] = static_cast<float>(-1.5 + 3.0 * byte / 255.0);
      }
      const int alpha = static_cast<int>(1 + i * 29 % 254);
      pixel("sh0")[3] = static_cast<unsigned char>(alpha);
      wanted.opacity_logits[i] =
          static_cast<float>(version == 1 ? -5.0 + 10.0 * alpha / 255.0 : std::log(alpha / (255.0 - alpha)));
      // The components but the largest, in 1/sqrt(2) of -1..1 and steps of 2/255.
      const std::size_t largest = i % 4;
      double squares = 0.0;
      int channel = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        if (a == largest) continue;
        const int byte = static_cast<int>(70 + (i * 41 + a * 67) % 116);
        pixel("quats")[channel++] = static_cast<unsigned char>(byte);
        const double v = (2.0 * byte / 255.0 - 1.0) * std::sqrt(0.5);
        wanted.rotations[4 * i + a] = static_cast<float>(v);
        squares += v * v;
      }
      wanted.rotations[4 * i + largest] = static_cast<float>(std::sqrt(1.0 - squares));
      pixel("quats")[3] = static_cast<unsigned char>(252 + largest);
      const int label = static_cast<int>(i) % sets;
      pixel("shN_labels")[0] = static_cast<unsigned char>(label);
      for (std::size_t j = 0; j < rest; ++j) {
        const cv::Vec4b value = centroids(label / 64, (label % 64) * static_cast<int>(rest) + static_cast<int>(j));
        for (int c = 0; c < 3; ++c) {
          wanted.sh[3 * ((rest + 1) * i + 1 + j) + static_cast<std::size_t>(c)] =
              static_cast<float>(-0.5 + value[c] / 255.0);
        }
      }
    }
    for (const auto& [name, image] : images) files[name + ".webp"] = webp(image);
    files["shN_centroids.webp"] = webp(centroids);
    const auto book = [](double from, double to) {
      Json values = Json::array();
      for (int b = 0; b < 256; ++b) values.push_back(from + (to - from) * b / 255.0);
      return values;
    };
    meta["means"] = {{"mins", least}, {"maxs", most}, {"files", {"means_l.webp", "means_u.webp"}}};
    meta["quats"] = {{"files", {"quats.webp"}}};
    meta["scales"] = {{"files", {"scales.webp"}}};
    meta["sh0"] = {{"files", {"sh0.webp"}}};
    if (degree > 0) meta["shN"] = {{"files", {"shN_centroids.webp", "shN_labels.webp"}}};
    if (version == 1) {
      meta["means"]["shape"] = {count, 3};
      meta["scales"].update({{"mins", {-8, -8, -8}}, {"maxs", {-2, -2, -2}}});
      meta["sh0"].update({{"mins", {-1.5, -1.5, -1.5, -5}}, {"maxs", {1.5, 1.5, 1.5, 5}}});
      if (degree > 0) meta["shN"].update({{"mins", -0.5}, {"maxs", 0.5}});
    } else {
      meta["version"] = 2;
      meta["count"] = count;
      meta["scales"]["codebook"] = book(-8, -2);
      meta["sh0"]["codebook"] = book(-1.5, 1.5);
      if (degree > 0) meta["shN"].update({{"bands", degree}, {"count", sets}, {"codebook", book(-0.5, 0.5)}});
    }
  }

  std::string archive(bool compress = false) const {
    std::vector<std::pair<std::string, std::string>> members{{"meta.json", meta.dump()}};
    members.insert(members.end(), files.begin(), files.end());
    return test::zip_bytes(members, compress);
  }
};

std::string no_sibling(const std::string& name) { throw InputError(name, "was asked for"); }

std::string fault(const MadeSog& sog) {
  return fault_of([&] { parse_sog("m.sog", sog.archive(), no_sibling); });
}

TEST(Sog, EveryVersionAndDegreeIsRead) {
  for (const int version : {1, 2}) {
    for (int degree = 0; degree <= 3; ++degree) {
      const MadeSog sog(version, degree, 90, {10, 9});
      const ForeignMap map = parse_sog("m.sog", sog.archive(degree % 2 == 1), no_sibling);
      test::expect_near(map.gaussians, sog.wanted, {2e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6});
      EXPECT_TRUE(map.lines.empty());
    }
  }
}

TEST(Sog, MayBeAFolder) {
  MadeSog sog(2, 1, 20, {5, 4});
  sog.meta["antialias"] = true;
  const auto sibling = [&](const std::string& name) { return sog.files.at(name); };
  const ForeignMap map = parse_sog("d/meta.json", sog.meta.dump(), sibling);
  test::expect_near(map.gaussians, sog.wanted, {2e-6, 1e-6, 1e-6, 1e-6, 1e-6, 1e-6});
  EXPECT_THAT(map.lines, testing::ElementsAre("compensated 1"));
  EXPECT_THAT(sog_lines("d/meta.json", sog.meta.dump()), testing::ElementsAre("compensated 1"));
}

TEST(Sog, AFirstValueThatIsMissingInACodebookIsContinued) {
  MadeSog sog(2, 0, 20, {5, 4});
  sog.meta["scales"]["codebook"][0] = nullptr;
  const Gaussians g = parse_sog("m.sog", sog.archive(), no_sibling).gaussians;
  EXPECT_NEAR(g.log_scales[0], -8.0, 0.002);  // one step of 6/255 before, by the mean of the other 254
}

TEST(Sog, FaultsAreNamed) {
  const MadeSog good(2, 1, 20, {5, 4});
  const std::string archive = good.archive();
  for (std::size_t n = 4; n < archive.size(); n += 7) {
    EXPECT_NE(fault_of([&] { parse_sog("m.sog", archive.substr(0, n), no_sibling); }), "") << n;
  }
  EXPECT_EQ(fault_of([&] {
              parse_sog("m.sog", test::zip_bytes({{"a.txt", "b"}}), no_sibling);
            }),
            "m.sog: is a ZIP archive, but holds no map (no meta.json of SOG): unpack it first");
  const auto with = [&](const auto& change) {
    MadeSog sog = good;
    change(sog);
    return fault(sog);
  };
  EXPECT_THAT(with([](MadeSog& s) { s.meta["version"] = 3; }), HasSubstr("version: is not read"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["count"] = 0; }), HasSubstr("count: must be a whole number in 1.."));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["count"] = 21; }), HasSubstr("has 20 pixels, must have 21 at least"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["count"] = 200'000'000; }), HasSubstr("bytes of data, more than its"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta.erase("quats"); }), HasSubstr("quats.files: is missing"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["means"]["mins"] = {1, 2}; }), HasSubstr("means.mins: must be 3 numbers"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["scales"]["codebook"].erase(0); }), HasSubstr("must be 256 numbers"));
  EXPECT_THAT(with([](MadeSog& s) { s.files.erase("sh0.webp"); }), HasSubstr("`sh0.webp`: is missing in the archive"));
  EXPECT_THAT(with([](MadeSog& s) { s.files["sh0.webp"] = "RIFF"; }), HasSubstr("sh0.webp: is no WebP image"));
  EXPECT_THAT(with([](MadeSog& s) { s.files["sh0.webp"] = webp(cv::Mat4b(4, 5, cv::Vec4b(9, 99, 200, 255)), 50); }),
              HasSubstr("sh0.webp: is a lossy WebP image"));
  EXPECT_THAT(with([](MadeSog& s) { s.files["sh0.webp"] = webp(cv::Mat4b(600, 600, cv::Vec4b(9, 9, 9, 255))); }),
              HasSubstr("sh0.webp: is 600x600, must have at most"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["shN"]["bands"] = 2; }), HasSubstr("is not of the size"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["shN"]["bands"] = 4; }),
              HasSubstr("shN.bands: must be a whole number in 1..3"));
  EXPECT_THAT(with([](MadeSog& s) { s.meta["shN"]["count"] = 5; }), HasSubstr("its set of harmonics is missing"));
  EXPECT_THAT(with([](MadeSog& s) { s.files["quats.webp"] = webp(cv::Mat4b(4, 5, cv::Vec4b(1, 2, 3, 99))); }),
              HasSubstr("the mark of its rotation is not in 252..255"));
}

}  // namespace
}  // namespace odosplat
