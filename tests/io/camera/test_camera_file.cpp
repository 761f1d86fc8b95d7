// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include "odosplat/io/camera/camera_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using test::TempFolder;
using testing::ElementsAre;

const std::string minimal = "width: 640\nheight: 480\nfx: 500.5\nfy: 501\ncx: 319.5\ncy: 239.5\n";

std::string without(const std::string& key) {
  std::string text = minimal;
  const std::size_t start = text.find(key + ":");
  text.erase(start, text.find('\n', start) + 1 - start);
  return text;
}

std::string with(const std::string& line) {
  const std::string key = line.substr(0, line.find(':'));
  return (minimal.find(key + ":") == std::string::npos ? minimal : without(key)) + line + "\n";
}

TEST(CameraFile, ReadsTheNeededKeysAndDefaultsTheRest) {
  const CameraFile file = parse_camera_file("c", minimal);
  EXPECT_EQ(file.camera, (Camera{640, 480, 500.5, 501.0, 319.5, 239.5}));
  EXPECT_EQ(file.fy_sign, 1);
  EXPECT_FALSE(file.has_depth_scale);
  EXPECT_TRUE(file.distortion.empty());
  EXPECT_EQ(file.fps, 0.0);
  EXPECT_EQ(file.time_offset, 0.0);
}

TEST(CameraFile, ReadsTheOptionalKeys) {
  const CameraFile file =
      parse_camera_file("c", minimal +
                                 "# a comment\ndepth_scale: 5000\ndistortion: [0.1, -0.2, 1e-3, 0]\n"
                                 "fps: 25\ntime_offset: -0.025\ngamma: 2.2\nvignette: vignette.png\n");
  EXPECT_EQ(file.depth_scale, 5000.0);
  EXPECT_TRUE(file.has_depth_scale);
  EXPECT_THAT(file.distortion, ElementsAre(0.1, -0.2, 1e-3, 0.0));
  EXPECT_EQ(file.fps, 25.0);
  EXPECT_EQ(file.time_offset, -0.025);
  EXPECT_EQ(file.depth_time_offset(), -0.025);
  EXPECT_EQ(file.gamma, 2.2);
  EXPECT_EQ(file.vignette, "vignette.png");
}

TEST(CameraFile, NegativeFyIsASign) {
  const CameraFile file = parse_camera_file("c", with("fy: -480"));
  EXPECT_EQ(file.camera.fy, 480.0);
  EXPECT_EQ(file.fy_sign, -1);
}

TEST(CameraFile, RoundTripKeepsEveryBit) {
  const TempFolder temp;
  CameraFile file;
  file.camera = {1200, 680, 481.2, 1000.0 / 3.0, 0.1 + 0.2, -1e-17};
  file.fy_sign = -1;
  file.depth_scale = 6553.5;
  file.distortion = {0.262383, -0.953104, -0.005358, 0.002628, 1.163314};
  file.fps = 29.97;
  file.time_offset = -1.0 / 30.0;
  file.gamma = 2.2;
  file.vignette = "a \"quoted\": # name\\.png";
  temp.put(file.vignette, "");
  write_camera_file(temp / "camera.yaml", file);
  const CameraFile read = read_camera_file(temp / "camera.yaml");
  EXPECT_EQ(read.camera, file.camera);
  EXPECT_EQ(read.fy_sign, -1);
  EXPECT_EQ(read.depth_scale, file.depth_scale);
  EXPECT_EQ(read.distortion, file.distortion);
  EXPECT_EQ(read.fps, file.fps);
  EXPECT_EQ(read.time_offset, file.time_offset);
  EXPECT_EQ(read.gamma, file.gamma);
  EXPECT_EQ(read.vignette, file.vignette);
}

TEST(CameraFile, TheTimeOfALineIsTheReadoutByTheRows) {
  const CameraFile file = parse_camera_file("c", minimal + "line_time: -2.5e-5\n");
  EXPECT_DOUBLE_EQ(file.camera.readout, -2.5e-5 * file.camera.height);
  EXPECT_DOUBLE_EQ(file.camera.level(2).readout, file.camera.readout);
  EXPECT_DOUBLE_EQ(file.camera.resized(40, 30).readout, file.camera.readout);
  const TempFolder temp;
  write_camera_file(temp / "camera.yaml", file);
  EXPECT_DOUBLE_EQ(read_camera_file(temp / "camera.yaml").camera.readout, file.camera.readout);
  EXPECT_EQ(parse_camera_file("c", minimal).camera.readout, 0.0);
  EXPECT_THAT(error_of([] { parse_camera_file("c", minimal + "line_time: 0.1\n"); }),
              testing::HasSubstr("at most 1 s"));
}

const std::string depth_camera_lines =
    "depth_camera:\n  width: 24\n  height: 18\n  fx: 22\n  fy: 23\n  cx: 12\n  cy: 9\n"
    "  T_color_depth: [-0.025, 0.001, 0.002, 0, 0, 0, 1]\n";

TEST(CameraFile, ADepthCameraIsReadAndWritten) {
  const CameraFile file = parse_camera_file("c", with("fx: 20") + "\n" + depth_camera_lines + "  time_offset: -0.01\n");
  ASSERT_TRUE(file.depth_camera.has_value());
  EXPECT_EQ(file.depth_camera->camera, (Camera{24, 18, 22, 23, 12, 9}));
  EXPECT_EQ(file.depth_camera->T_color_depth.translation(), Eigen::Vector3d(-0.025, 0.001, 0.002));
  EXPECT_EQ(file.depth_camera->time_offset, -0.01);
  const TempFolder temp;
  CameraFile turned = file;
  turned.depth_camera->T_color_depth = SE3(so3_exp({0.1, -0.2, 0.3}), {1.0 / 3.0, 0.0, -1e-9});
  write_camera_file(temp / "camera.yaml", turned);
  const CameraFile read = read_camera_file(temp / "camera.yaml");
  ASSERT_TRUE(read.depth_camera.has_value());
  EXPECT_EQ(read.depth_camera->camera, file.depth_camera->camera);
  EXPECT_EQ(read.depth_camera->T_color_depth.translation(), turned.depth_camera->T_color_depth.translation());
  EXPECT_LT((read.depth_camera->T_color_depth.inverse() * turned.depth_camera->T_color_depth).log().norm(), 1e-14);
  EXPECT_EQ(read.depth_camera->time_offset, -0.01);
}

TEST(CameraFile, TheTimeOffsetsOfImagesAndOfADepthCameraAreTwo) {
  const std::string both = with("fx: 20") + "\ntime_offset: 0.02\n" + depth_camera_lines;
  const CameraFile without_own = parse_camera_file("c", both);
  EXPECT_EQ(without_own.time_offset, 0.02);
  EXPECT_EQ(without_own.depth_time_offset(), 0.0);
  const TempFolder temp;
  write_camera_file(temp / "camera.yaml", parse_camera_file("c", both + "  time_offset: -0.01\n"));
  const CameraFile read = read_camera_file(temp / "camera.yaml");
  EXPECT_EQ(read.time_offset, 0.02);
  EXPECT_EQ(read.depth_time_offset(), -0.01);
}

TEST(CameraFile, ADepthCameraThatIsWrongIsRefused) {
  const auto fault = [](const std::string& from, const std::string& to, const std::string& camera = "fx: 20") {
    std::string lines = depth_camera_lines;
    lines.replace(lines.find(from), from.size(), to);
    return error_of([&] { parse_camera_file("c.yaml", with(camera) + "\n" + lines); });
  };
  EXPECT_EQ(fault("  fx: 22\n", ""), "c.yaml: depth_camera.fx: is missing");
  EXPECT_EQ(fault("fx: 22", "fx: much"), "c.yaml: depth_camera.fx: is not a number");
  EXPECT_EQ(fault("fx: 22", "fx: -22"), "c.yaml: depth_camera.fx: must be positive, is -22");
  EXPECT_EQ(fault("fx: 22", "fx: 22\n  fx: 22").find("c.yaml: depth_camera.fx: is given twice"), 0U);
  EXPECT_EQ(fault("cx: 12", "cx: 12\n  depth_scale: 3"), "c.yaml: depth_camera.depth_scale: is not a known key");
  EXPECT_EQ(fault("0, 0, 0, 1]", "0, 0, 1]"),
            "c.yaml: depth_camera.T_color_depth: must hold 7 numbers (tx ty tz qx qy qz qw), holds 6");
  EXPECT_EQ(fault("0, 0, 0, 1]", "0, 0, 0, 3]"),
            "c.yaml: depth_camera.T_color_depth: the quaternion has length 3, must be near 1 (0.5..2)");
  EXPECT_EQ(fault("-0.025", "-25"), "c.yaml: depth_camera.T_color_depth: its translation must be at most 10 m, is 25");
  EXPECT_EQ(fault("cx: 12", "cx: 12\n  time_offset: -11"),
            "c.yaml: depth_camera.time_offset: must be in -10..10, is -11");
  EXPECT_EQ(fault("width: 24", "width: 1"), "c.yaml: depth_camera.width: must be in 2..32768, is 1");
  EXPECT_EQ(fault("width: 24", "width: 24", "fy: -20"), "c.yaml: depth_camera: does not go with a negative fy");
  EXPECT_EQ(error_of([&] { parse_camera_file("c.yaml", with("fx: 20") + "\ndepth_camera: 3\n"); }),
            "c.yaml: depth_camera: is not a list of `key: value` lines");
}

TEST(CameraFile, AKeyGivenTwiceIsRefused) {
  EXPECT_EQ(error_of([&] {
              parse_camera_file("c.yaml", with("fx: 20") + "\nfx: 21\n");
            }).find("c.yaml: fx: is given twice, in lines "),
            0U);
}

TEST(CameraFile, AByteOrderMarkIsPassedOver) {
  const CameraFile file =
      parse_camera_file("c.yaml", "\xEF\xBB\xBFwidth: 16\nheight: 12\nfx: 20\nfy: 20\ncx: 8\ncy: 6\n");
  EXPECT_EQ(file.camera.width, 16);
}

class CameraFileKey : public testing::TestWithParam<std::string> {};

TEST_P(CameraFileKey, MissingIsNamed) {
  EXPECT_EQ(error_of([&] { parse_camera_file("c.yaml", without(GetParam())); }),
            "c.yaml: " + GetParam() + ": is missing");
}

TEST_P(CameraFileKey, WithoutNumberIsNamed) {
  for (const char* value : {"wide", "", "[1]", "640px", "{a: 1}"}) {
    EXPECT_EQ(error_of([&] { parse_camera_file("c.yaml", with(GetParam() + ": " + value)); }),
              "c.yaml: " + GetParam() + ": is not a number")
        << value;
  }
  EXPECT_EQ(error_of([&] { parse_camera_file("c.yaml", with(GetParam() + ": .nan")); }),
            "c.yaml: " + GetParam() + ": is not finite");
}

INSTANTIATE_TEST_SUITE_P(All, CameraFileKey, testing::Values("width", "height", "fx", "fy", "cx", "cy"));

TEST(CameraFile, NamesTheFieldThatIsOutOfRange) {
  const auto fault = [](const std::string& line) { return error_of([&] { parse_camera_file("c", with(line)); }); };
  EXPECT_THAT(fault("fx: 0"), testing::StartsWith("c: fx: must be positive"));
  EXPECT_THAT(fault("fx: -500"), testing::StartsWith("c: fx: must be positive"));
  EXPECT_THAT(fault("fy: 0"), testing::StartsWith("c: fy: must be positive"));
  EXPECT_THAT(fault("width: 0"), testing::StartsWith("c: width: must be in"));
  EXPECT_THAT(fault("height: 40000"), testing::StartsWith("c: height: must be in"));
  EXPECT_THAT(fault("width: 640.5"), testing::StartsWith("c: width: is not a whole number"));
  EXPECT_THAT(fault("depth_scale: 0"), testing::StartsWith("c: depth_scale: must be positive"));
  EXPECT_THAT(fault("fps: -1"), testing::StartsWith("c: fps: must be positive"));
  EXPECT_THAT(fault("gamma: 0"), testing::StartsWith("c: gamma: must be positive"));
}

TEST(CameraFile, WantsFourOrFiveDistortionNumbers) {
  const auto fault = [](const std::string& line) { return error_of([&] { parse_camera_file("c", with(line)); }); };
  EXPECT_EQ(fault("distortion: [1, 2, 3]"), "c: distortion: must hold 4 or 5 numbers, holds 3");
  EXPECT_EQ(fault("distortion: [1, 2, 3, 4, 5, 6]"), "c: distortion: must hold 4 or 5 numbers, holds 6");
  EXPECT_EQ(fault("distortion: 0.1"), "c: distortion: is not a list");
  EXPECT_EQ(fault("distortion: [1, 2, x, 4]"), "c: distortion: is not a number");
}

TEST(CameraFile, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(error_of([] { parse_camera_file("c", minimal + "distorsion: [0, 0, 0, 0]\n"); }),
            "c: distorsion: is not a known key");
  EXPECT_EQ(error_of([] { parse_camera_file("c", minimal + "\"of two\\nlines\": 1\n"); }),
            "c: of two\\x0alines: is not a known key");
  for (const char* text : {"", "- 1\n- 2\n", "just words", "42"}) {
    EXPECT_THAT(error_of([&] { parse_camera_file("c", text); }), testing::StartsWith("c: ")) << text;
  }
  EXPECT_THAT(error_of([] { parse_camera_file("c", "width: [1, 2\nheight: }"); }), testing::StartsWith("c: line "));
  EXPECT_THAT(error_of([] { parse_camera_file("c", std::string(100000, '[')); }), testing::StartsWith("c: "));
}

TEST(CameraFile, MissingFileIsNamed) {
  EXPECT_EQ(error_of([] { read_camera_file("/nowhere/camera.yaml"); }), "/nowhere/camera.yaml: is missing");
}

}  // namespace
}  // namespace odosplat
