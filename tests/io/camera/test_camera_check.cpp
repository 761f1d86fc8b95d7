// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_check.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "odosplat/io/camera/photometric.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/sequence/colmap_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::HasSubstr;
using testing::StartsWith;

const std::string sound = "width: 320\nheight: 240\nfx: 240\nfy: 240\ncx: 159.5\ncy: 119.5\n";

std::string with(const std::string& key, const std::string& value) {
  const std::size_t at = sound.find(key + ":");
  if (at == std::string::npos) return sound + key + ": " + value + "\n";
  std::string text = sound;
  return text.replace(at, text.find('\n', at) - at, key + ": " + value);
}

std::string fault(const std::string& key, const std::string& value) {
  return error_of([&] { parse_camera_file("c", with(key, value)); });
}

TEST(CameraCheck, NumbersThatNoLensHasAreNamed) {
  EXPECT_EQ(fault("fx", "1e300"), "c: fx: must be in 0.32..1e+06 for an image of 320 px, is 1e+300");
  EXPECT_EQ(fault("fx", "1e-300"), "c: fx: must be in 0.32..1e+06 for an image of 320 px, is 1e-300");
  EXPECT_EQ(fault("fy", "0.2"), "c: fy: must be in 0.24..1e+06 for an image of 240 px, is 0.2");
  EXPECT_EQ(fault("cx", "1e6"), "c: cx: must be within 32768 px of the image, is 1e+06");
  EXPECT_EQ(fault("cy", "-40000"), "c: cy: must be within 32768 px of the image, is -40000");
  EXPECT_EQ(fault("gamma", "1e9"), "c: gamma: must be in 0.1..10, is 1e+09");
  EXPECT_EQ(fault("gamma", "1e-9"), "c: gamma: must be in 0.1..10, is 1e-09");
  EXPECT_EQ(fault("fps", "1e300"), "c: fps: must be in 1e-06..1e+06, is 1e+300");
  EXPECT_EQ(fault("time_offset", "10.5"), "c: time_offset: must be in -10..10, is 10.5");
  EXPECT_EQ(fault("time_offset", "-1e300"), "c: time_offset: must be in -10..10, is -1e+300");
  EXPECT_EQ(fault("time_offset", ".inf"), "c: time_offset: is not finite");
  EXPECT_EQ(fault("time_offset", "soon"), "c: time_offset: is not a number");
  EXPECT_EQ(fault("depth_scale", "1e-300"), "c: depth_scale: must be in 0.001..1e+09, is 1e-300");
  // Unusual but valid: an image cut out of a larger one, a telescope, an extremely wide lens.
  for (const auto& [key, value] : {std::pair{"cx", "-900"}, {"fx", "50000"}, {"fx", "2"}}) {
    EXPECT_NO_THROW(parse_camera_file("c", with(key, value))) << key;
  }
}

TEST(CameraCheck, ALensThatFoldsWithinTheImageIsRefused) {
  // r (1 - 5 r^2) has its maximum of 0.172 at r = 0.258, which is 41 px.
  EXPECT_THAT(fault("distortion", "[-5, 0, 0, 0, 0]"),
              StartsWith("c: distortion: [-5, 0, 0, 0, 0] folds within the image: about 38 px from cx, cy"));
  const Camera camera{320, 240, 240.0, 240.0, 159.5, 119.5};
  EXPECT_NEAR(fold_radius(camera, {-5.0, 0.0, 0.0, 0.0, 0.0}), 41.3, 3.5);
  for (const char* folding : {"[-0.4, 0, 0, 0]", "[0, -3, 0, 0]", "[0, 0, 0, 0, -9]", "[0, 0, 2, 0]", "[0, 0, 0, -2]",
                              "[1e300, 0, 0, 0]", "[0, 0, 0, 0, -1e300]"}) {
    EXPECT_THAT(fault("distortion", folding), HasSubstr("folds within the image")) << folding;
  }
  // Beyond the fold the radius grows again, but the rays in between are still ambiguous.
  EXPECT_THAT(fault("distortion", "[-6, 9, 0, 0, 6]"), HasSubstr("folds within the image"));
}

// Published calibrations: these lens models do not fold within the image.
TEST(CameraCheck, LensesOfDataSetsPass) {
  const double none = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fold_radius({640, 480, 517.3, 516.5, 318.6, 255.3}, {0.2624, -0.9531, -0.0054, 0.0026, 1.1633}), none);
  EXPECT_EQ(fold_radius({640, 480, 520.9, 521.0, 325.1, 249.7}, {0.2312, -0.7849, -0.0033, -0.0001, 0.9172}), none);
  EXPECT_EQ(fold_radius({752, 480, 458.654, 457.296, 367.215, 248.375},
                        {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05}),
            none);
  EXPECT_EQ(fold_radius({1392, 512, 984.2, 980.8, 690.0, 233.2}, {-0.37288, 0.20373, 0.0022, 0.00138, -0.07233}), none);
  EXPECT_EQ(fold_radius({640, 480, 500.0, 500.0, 320.0, 240.0}, {0.0, 0.0, 0.0, 0.0}), none);
  EXPECT_EQ(fold_radius({640, 480, 500.0, 500.0, 320.0, 240.0}, {0.5, 0.0, 0.0, 0.0}), none);  // pincushion
}

TEST(CameraCheck, AFoldInTheCornersAlonePasses) {
  const Camera camera{640, 480, 384.0, 384.0, 319.5, 239.5};
  const double radius = fold_radius(camera, {-0.2, 0.0, 0.0, 0.0});
  EXPECT_GT(radius, 320.0);
  EXPECT_LT(radius, 400.0);
  EXPECT_NO_THROW(parse_camera_file("c",
                                    "width: 640\nheight: 480\nfx: 384\nfy: 384\ncx: 319.5\ncy: 239.5\n"
                                    "distortion: [-0.2, 0, 0, 0]\n"));
}

// The fold is where the distorted radius, computed in small steps, has its maximum.
TEST(CameraCheck, FoldsWhereTheRadiusTurnsBack) {
  const Camera camera{640, 480, 400.0, 400.0, 319.5, 239.5};
  for (const double k1 : {-0.5, -0.8, -2.0}) {
    double largest = 0.0;
    for (double r = 0.0; r < 3.0; r += 1e-4) {
      largest = std::max(largest, r * (1.0 + k1 * r * r));
      if (1.0 + 3.0 * k1 * r * r < 0.0) break;
    }
    // tolerance: the search takes 64 steps along a line
    EXPECT_NEAR(fold_radius(camera, {k1, 0.0, 0.0, 0.0}), 400.0 * largest, 400.0 / 64.0 + 1.0) << k1;
  }
}

TEST(CameraCheck, EveryLayoutsCameraIsChecked) {
  const cv::Mat3b image(12, 16, cv::Vec3b(9, 9, 9));
  {
    const TempFolder temp;
    test::ColmapModel model;
    model.cameras = {{7, 4, "OPENCV", 16, 12, {12.0, 12.0, 8.0, 6.0, -5.0, 0.0, 0.0, 0.0}}};
    model.images = {{1, {}, 7, "a.png", 0}};
    temp.put("cameras.txt", model.cameras_text());
    temp.put("images.txt", model.images_text());
    temp.put("points3D.txt", model.points_text());
    temp.put_image("images/a.png", image);
    EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
                HasSubstr("cameras.txt: distortion: [-5, 0, 0, 0] folds"));
  }
  {
    const TempFolder temp;
    temp.put("transforms.json",
             R"({"w": 16, "h": 12, "fl_x": 12, "cx": 8, "cy": 6, "k1": -5, "frames": [{"file_path": "a.png",
             "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]}]})");
    temp.put_image("a.png", image);
    EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
                HasSubstr("transforms.json: distortion: [-5, 0, 0, 0, 0] folds"));
  }
}

TEST(CameraCheck, OnlyOneDocumentIsTaken) {
  EXPECT_EQ(error_of([] { parse_camera_file("c", sound + "---\nfx: 300\n"); }),
            "c: content: holds several YAML documents (`---`), must hold one");
  EXPECT_EQ(parse_camera_file("c", "---\n" + sound + "...\n").camera.fx, 240.0);
}

// yaml-cpp finds documents without end in such texts.
TEST(CameraCheck, ATextWithDocumentsWithoutEndIsRefused) {
  for (const std::string& text : {std::string(", 0,8\xd1w"), sound + "---\n, 0,8\n---\n"}) {
    EXPECT_EQ(error_of([&] { parse_camera_file("c", text); }),
              "c: content: holds several YAML documents (`---`), must hold one");
  }
}

TEST(CameraCheck, AVignetteThatIsMissingIsNamed) {
  const TempFolder temp;
  const std::string file = temp.put("camera.yaml", with("vignette", "lens.png"));
  EXPECT_EQ(error_of([&] { read_camera_file(file); }), file + ": vignette: " + (temp / "lens.png") + ": is missing");
  temp.put_image("lens.png", cv::Mat1b(240, 320, std::uint8_t{255}));
  EXPECT_EQ(read_camera_file(file).vignette, "lens.png");
}

TEST(CameraCheck, ExposuresSayTheirRange) {
  EXPECT_EQ(error_of([] {
              parse_exposures("e.txt", "0 1\n1 1\n2 1e300\n", {0.0, 1.0, 2.0});
            }),
            "e.txt: frame 2: its exposure 1e+300 is 1e+300 times the median, must be 1e-6..1e6 times it");
  EXPECT_EQ(error_of([] { PhotometricCorrection(1.0, {}).apply(ColorImage(2, 2), 1e300); }),
            "exposure: must be in 1e-6..1e6 (1: the median)");
}

}  // namespace
}  // namespace odosplat
