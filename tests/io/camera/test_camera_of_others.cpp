// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
// Camera files of OpenCV, ROS, Kalibr and EuRoC.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "odosplat/io/camera/camera_file.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using test::error_of;
using testing::ElementsAre;
using testing::HasSubstr;

const Camera expected{640, 480, 525.5, 526.5, 319.25, 240.75};

const std::string ros_calibration =
    "image_width: 640\nimage_height: 480\ncamera_name: head\n"
    "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [525.5, 0, 319.25, 0, 526.5, 240.75, 0, 0, 1]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.2, 0.001, -0.002, 0.03]\n"
    "rectification_matrix:\n  rows: 3\n  cols: 3\n  data: [1, 0, 0, 0, 1, 0, 0, 0, 1]\n";

const std::string opencv =
    "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\n"
    "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
    "   data: [ 5.255e+02, 0., 319.25, 0., 526.5, 2.4075e+02, 0., 0., 1. ]\n"
    "distortion_coefficients: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
    "   data: [ 0.1, -0.2, 0.001, -0.002, 0.03 ]\navg_reprojection_error: 0.2\n";

const std::string ros_message =
    "header:\n  frame_id: head\nheight: 480\nwidth: 640\ndistortion_model: plumb_bob\n"
    "d: [0.1, -0.2, 0.001, -0.002, 0.03]\nk: [525.5, 0.0, 319.25, 0.0, 526.5, 240.75, 0.0, 0.0, 1.0]\n"
    "binning_x: 0\nroi:\n  x_offset: 0\n---\n";

const std::string kalibr =
    "cam0:\n  cam_overlaps: []\n  camera_model: pinhole\n  distortion_coeffs: [0.1, -0.2, 0.001, -0.002]\n"
    "  distortion_model: radtan\n  intrinsics: [525.5, 526.5, 319.25, 240.75]\n  resolution: [640, 480]\n"
    "  rostopic: /cam0/image_raw\n";

const std::string euroc =
    "sensor_type: camera\nT_BS:\n  cols: 4\n  rows: 4\nrate_hz: 20\nresolution: [640, 480]\ncamera_model: pinhole\n"
    "intrinsics: [525.5, 526.5, 319.25, 240.75] # fu, fv, cu, cv\ndistortion_model: radial-tangential\n"
    "distortion_coefficients: [0.1, -0.2, 0.001, -0.002]\n";

TEST(CameraOfOthers, IsReadFromEveryForm) {
  for (const std::string& text : {ros_calibration, opencv, ros_message}) {
    const CameraFile file = parse_camera_file("c.yaml", text);
    EXPECT_EQ(file.camera, expected) << text;
    EXPECT_THAT(file.distortion, ElementsAre(0.1, -0.2, 0.001, -0.002, 0.03)) << text;
    EXPECT_FALSE(file.has_depth_scale);
  }
  for (const std::string& text : {kalibr, euroc}) {
    const CameraFile file = parse_camera_file("c.yaml", text);
    EXPECT_EQ(file.camera, expected) << text;
    EXPECT_THAT(file.distortion, ElementsAre(0.1, -0.2, 0.001, -0.002)) << text;
  }
  EXPECT_EQ(parse_camera_file("c.yaml", euroc).fps, 20.0);
}

std::string fault(std::string text, const std::string& from, const std::string& to) {
  text.replace(text.find(from), from.size(), to);
  return error_of([&] { parse_camera_file("c.yaml", text); });
}

TEST(CameraOfOthers, RefusesWhatIsNotRead) {
  EXPECT_EQ(
      fault(ros_calibration, "plumb_bob", "equidistant"),
      "c.yaml: distortion_model: `equidistant` is not read: fisheye and omnidirectional lenses are not, undistort "
      "the images");
  EXPECT_THAT(fault(kalibr, "radtan", "equi"), HasSubstr("c.yaml: cam0.distortion_model: `equi` is not read: fisheye"));
  EXPECT_THAT(fault(kalibr, "pinhole", "ds"), HasSubstr("c.yaml: cam0.camera_model: `ds` is not read"));
  EXPECT_EQ(fault(ros_message, "[0.1, -0.2, 0.001, -0.002, 0.03]", "[0.1, 0, 0, 0, 0, 0.5, 0, 0]"),
            "c.yaml: d: has 8 coefficients; only k1 k2 p1 p2 k3 are read, and the others are not 0");
  EXPECT_EQ(fault(ros_message, "binning_x: 0", "binning_x: 2"), "c.yaml: binning_x: binned images are not read");
  EXPECT_EQ(fault(opencv, "5.255e+02, 0.,", "5.255e+02, 3.,"),
            "c.yaml: camera_matrix.data: must be [fx, 0, cx, 0, fy, cy, 0, 0, 1]");
  EXPECT_EQ(fault(kalibr, "intrinsics: [525.5, 526.5, 319.25, 240.75]", "intrinsics: [525.5]"),
            "c.yaml: cam0.intrinsics: must hold fx, fy, cx, cy, holds 1 numbers");
  EXPECT_EQ(fault(kalibr, "resolution: [640, 480]", "resolution: [640.5, 480]"),
            "c.yaml: cam0.resolution: must be two whole numbers, width and height");
  EXPECT_EQ(fault(kalibr, "cam0:", "cam1:\n  camera_model: pinhole\ncam0:"),
            "c.yaml: cam1: is a second camera: leave one in the file");
  EXPECT_EQ(fault(euroc, "526.5,", "-526.5,"), "c.yaml: fy: must be positive, is -526.5");
  EXPECT_EQ(fault(ros_calibration, "image_width: 640\n", ""), "c.yaml: image_width: is missing");
}

TEST(CameraOfOthers, TakesOurOwnKeysToo) {
  const CameraFile file =
      parse_camera_file("c.yaml", ros_calibration +
                                      "depth_scale: 5000\nfps: 15\ntime_offset: 0.02\n"
                                      "depth_camera:\n  width: 24\n  height: 18\n  fx: 22\n  fy: 23\n  cx: 12\n"
                                      "  cy: 9\n  T_color_depth: [-0.025, 0.001, 0.002, 0, 0, 0, 1]\n");
  EXPECT_EQ(file.camera, expected);
  EXPECT_EQ(file.depth_scale, 5000.0);
  EXPECT_TRUE(file.has_depth_scale);
  EXPECT_EQ(file.fps, 15.0);
  EXPECT_EQ(file.time_offset, 0.02);
  EXPECT_TRUE(file.depth_camera.has_value());
}

TEST(CameraOfOthers, DistortionIsNotLost) {
  std::string listed = ros_calibration;
  const std::size_t at = listed.find("distortion_coefficients:");
  listed.replace(at, listed.find("rectification") - at, "distortion_coefficients: [0.1, -0.2, 0, 0]\n");
  EXPECT_THAT(parse_camera_file("c.yaml", listed).distortion, ElementsAre(0.1, -0.2, 0.0, 0.0));
  EXPECT_EQ(fault(kalibr, "  distortion_coeffs: [0.1, -0.2, 0.001, -0.002]\n", ""),
            "c.yaml: cam0.distortion_coeffs: is missing for distortion_model radtan");
  EXPECT_EQ(fault(kalibr, "radtan", "none"), "c.yaml: cam0.distortion_coeffs: is not 0, and distortion_model is none");
}

TEST(CameraOfOthers, CoefficientsOfZeroAreNoDistortion) {
  std::string text = ros_message;
  text.replace(text.find("[0.1, -0.2, 0.001, -0.002, 0.03]"), 32, "[0, 0, 0, 0, 0, 0, 0, 0]");
  EXPECT_TRUE(parse_camera_file("c.yaml", text).distortion.empty());
}

}  // namespace
}  // namespace odosplat
