// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "odosplat/io/cloud/cloud_file.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "odosplat/io/sequence/transforms_file.hpp"
#include "odosplat/io/text/json_text.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

using nlohmann::json;
using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

// The camera of frame k looks along the world's +x from (k, 0, 1); the world's z is up. Columns: right, up, backward.
json matrix(int k) { return {{0, 0, -1, k}, {-1, 0, 0, 0}, {0, 1, 0, 1}, {0, 0, 0, 1}}; }

json tiny() {
  json file{
      {"camera_model", "OPENCV"}, {"w", 16}, {"h", 12}, {"fl_x", 20.0}, {"fl_y", 21.0}, {"cx", 8.25}, {"cy", 6.5}};
  for (int k = 0; k < 3; ++k) {
    file["frames"].push_back(
        {{"file_path", "images/" + std::to_string(7 + k) + ".png"}, {"transform_matrix", matrix(k)}});
  }
  return file;
}

void put(const TempFolder& temp, const json& file, const std::string& name = "transforms.json") {
  temp.put(name, file.dump());
  for (int k = 0; k < 3; ++k) {
    temp.put_image("images/" + std::to_string(7 + k) + ".png", cv::Mat3b(12, 16, cv::Vec3b::all(uchar(20 * k))));
    temp.put_image("depth/" + std::to_string(7 + k) + ".png", cv::Mat1w(12, 16, static_cast<std::uint16_t>(1500)));
  }
}

TEST(SequenceNerfstudio, ReadsFrames) {
  const TempFolder temp;
  put(temp, tiny());
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.layout(), "nerfstudio");
  EXPECT_EQ(s.camera(), (Camera{16, 12, 20, 21, 7.75, 6.0}));
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s.truth().size(), 3U);
  EXPECT_FALSE(s.has_depth(0));
  EXPECT_FALSE(s.has_sparse_points());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.color(i)(3, 3)[0], 20.0F * static_cast<float>(i) / 255.0F, 1e-6F);
    EXPECT_NEAR(s.time(i), static_cast<double>(i) / 30.0, 1e-12);
  }
  // Two metres ahead, half a metre to the right (world -y) and a quarter up: to the right of the centre and above it.
  const Eigen::Vector3d p_camera = s.T_world_camera(1)->inverse() * Eigen::Vector3d(3.0, -0.5, 1.25);
  EXPECT_LT((p_camera - Eigen::Vector3d(0.5, -0.25, 2.0)).norm(), 1e-9);
  const Eigen::Vector2d pixel = s.camera().project(p_camera);
  EXPECT_NEAR(pixel.x() + 0.5, 20.0 * 0.25 + 8.25, 1e-9);
  EXPECT_NEAR(pixel.y() + 0.5, -21.0 * 0.125 + 6.5, 1e-9);
}

TEST(SequenceNerfstudio, ReadsDepthAndPoints) {
  const TempFolder temp;
  json file = tiny();
  file["frames"][1]["depth_file_path"] = "depth/8.png";
  file["applied_transform"] = {{0, 1, 0, 0}, {1, 0, 0, 0}, {0, 0, -1, 0}};
  file["ply_file_path"] = "sparse.ply";
  put(temp, file);
  PointCloud points;
  points.points = {{1, 2, 3}};
  write_point_cloud(temp / "sparse.ply", points);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.has_depth(0));
  ASSERT_TRUE(s.has_depth(1));
  EXPECT_NEAR(s.depth(1)(2, 2), 1.5F, 1e-6F);
  EXPECT_EQ(s.sparse_points().points.front(), Eigen::Vector3f(1, 2, 3));
  // The poses are those stored; applied_transform is ignored.
  EXPECT_LT((s.T_world_camera(2)->translation() - Eigen::Vector3d(2, 0, 1)).norm(), 1e-12);
  file["depth_unit_scale_factor"] = 0.0002;
  put(temp, file);
  EXPECT_NEAR(Sequence::open(temp.path()).depth(1)(2, 2), 0.3F, 1e-6F);
}

TEST(SequenceNerfstudio, ReadsTheSyntheticForm) {
  const TempFolder temp;
  json file = tiny();
  for (const char* key : {"camera_model", "w", "h", "fl_x", "fl_y", "cx", "cy"}) file.erase(key);
  file["camera_angle_x"] = 2.0 * std::atan(0.4);
  for (json& frame : file["frames"]) {
    const std::string path = frame["file_path"];
    frame["file_path"] = "./" + path.substr(0, path.size() - 4);
  }
  put(temp, file, "transforms_train.json");
  const Sequence s = Sequence::open(temp / "transforms_train.json");
  EXPECT_EQ(s.layout(), "nerfstudio");
  EXPECT_EQ(s.camera().width, 16);
  EXPECT_NEAR(s.camera().fx, 20.0, 1e-9);
  EXPECT_NEAR(s.camera().fy, 20.0, 1e-9);
  EXPECT_EQ(s.camera().cx, 7.5);
  EXPECT_EQ(s.camera().cy, 5.5);
}

TEST(TransformsFile, TakesCamerasOfFrames) {
  json file = tiny();
  file.erase("fl_x");
  for (json& frame : file["frames"]) {
    frame["fl_x"] = 25.0;
    frame["k1"] = 0.1;
    frame["k3"] = 0.3;
    frame["p2"] = -0.1;
  }
  const TransformsFile read = parse_transforms("t", file.dump());
  const CameraFile camera = read.camera("t", {});
  EXPECT_EQ(camera.camera.fx, 25.0);
  EXPECT_EQ(camera.distortion, (std::vector<double>{0.1, 0, 0, -0.1, 0.3}));
  file["frames"][2]["k1"] = 0.2;
  EXPECT_THAT(error_of([&] { parse_transforms("t", file.dump()).camera("t", {}); }),
              HasSubstr("t: frame 3 (images/9.png): has another camera than frame 1 (images/7.png)"));
}

TEST(TransformsFile, CamerasThatDifferByLessThanHalfAPixelAreOne) {
  const double focal[] = {20.1, 20.3, 20.0};
  json file = tiny();
  for (std::size_t i = 0; i < 3; ++i) file["frames"][i]["fl_x"] = focal[i];
  EXPECT_EQ(parse_transforms("t", file.dump()).camera("t", {}).camera.fx, 20.1);
  file["frames"][1]["fl_x"] = 20.7;
  EXPECT_EQ(
      error_of([&] { parse_transforms("t", file.dump()).camera("t", {}); }),
      "t: frame 2 (images/8.png): has another camera than frame 1 (images/7.png) (their intrinsics differ by 0.60 "
      "px); a sequence has one (split the file by camera, or --camera)");
  file["frames"][1]["fl_x"] = 20.1;
  file["frames"][1]["w"] = 20;
  EXPECT_THAT(error_of([&] { parse_transforms("t", file.dump()).camera("t", {}); }), HasSubstr("(another size)"));
}

TEST(TransformsFile, FramesMayLackAPose) {
  const auto without = [](const std::string& written) {
    json file = tiny();
    file["frames"][1]["transform_matrix"] = "here";
    std::string text = file.dump();
    text.replace(text.find("\"here\""), 6, written);
    const TransformsFile read = parse_transforms("t", text);
    return read.frames[0].T_world_camera && !read.frames[1].T_world_camera && read.frames[2].T_world_camera;
  };
  EXPECT_TRUE(without("null"));
  EXPECT_TRUE(without("[[NaN, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"));
  EXPECT_TRUE(without("[[1, 0, 0, -Infinity], [0, 1, 0, Infinity], [0, 0, 1, 0]]"));
  json file = tiny();
  file["frames"][0].erase("transform_matrix");
  EXPECT_FALSE(parse_transforms("t", file.dump()).frames[0].T_world_camera);
  for (json& frame : file["frames"]) frame["transform_matrix"] = nullptr;
  EXPECT_EQ(error_of([&] { parse_transforms("t", file.dump()); }),
            "t: frame 1: transform_matrix: is missing or not finite, as in every frame");
}

TEST(JsonText, FaultsNameLineAndColumn) {
  const auto fault = [](const std::string& text) { return error_of([&] { parse_json_object("j", text); }); };
  EXPECT_EQ(fault("{\n \"a\": [1, 2,\n ]}\n"), "j: line 3, column 2: is not JSON: there is a comma before `]`");
  EXPECT_EQ(fault("{\"a\": 1,}"), "j: line 1, column 9: is not JSON: there is a comma before `}`");
  EXPECT_THAT(fault("{\"a\": NaN, \"b\": nan}"), HasSubstr("j: line 1, column 18: is not JSON: "));
  EXPECT_THAT(fault("{\"a\": Infinity, \"b\": x}"), HasSubstr("j: line 1, column 22: is not JSON: "));
  EXPECT_THAT(fault("{\n\n"), HasSubstr("j: line 3, column 1: is not JSON: "));
  EXPECT_THAT(fault(""), HasSubstr("j: line 1, column 1: is not JSON: "));
  EXPECT_THAT(fault("{\"a\": \"\xff\"}"), HasSubstr("j: line 1, column 8: is not JSON: "));
  EXPECT_EQ(fault("[1]"), "j: is not a JSON object");
}

TEST(JsonText, NumbersThatPythonAddsAreNull) {
  const json read = parse_json_object(
      "j", "\xEF\xBB\xBF{\"a\": NaN, \"b\": [-Infinity,Infinity,-NaN], \"NaN\": \"is \\\"NaN, \\\\\", \"c\": NaN}");
  EXPECT_TRUE(read["a"].is_null());
  EXPECT_EQ(read["b"], json({nullptr, nullptr, nullptr}));
  EXPECT_EQ(read["NaN"], "is \"NaN, \\");
  EXPECT_TRUE(read["c"].is_null());
}

TEST(TransformsFile, NamesEveryFault) {
  const auto fault = [](const json& file) {
    return error_of([&] { parse_transforms("t.json", file.dump()).camera("t.json", {}); });
  };
  const auto with = [](const char* key, const json& value) {
    json file = tiny();
    file[key] = value;
    return file;
  };
  const auto with_frame = [](const char* key, const json& value) {
    json file = tiny();
    file["frames"][1][key] = value;
    return file;
  };
  EXPECT_THAT(error_of([] { parse_transforms("t.json", "{"); }), HasSubstr("t.json: line 1, column 2: is not JSON"));
  EXPECT_THAT(fault(json::array()), HasSubstr("is not a JSON object"));
  EXPECT_THAT(fault(with("frames", json::array())), HasSubstr("frames: lists no image"));
  EXPECT_THAT(fault(with("frames", 3)), HasSubstr("frames: is missing or no list"));
  EXPECT_THAT(fault(with("frames", {3})), HasSubstr("frame 1: is not an object"));
  EXPECT_THAT(fault(with("fl_x", "20")), HasSubstr("fl_x: is not a number"));
  EXPECT_THAT(fault(with("fl_x", -1)), HasSubstr("fx: must be positive"));
  EXPECT_THAT(fault(with("w", 1.5)), HasSubstr("w: is not a size"));
  EXPECT_THAT(fault(with("h", 1e6)), HasSubstr("h: is not a size"));
  EXPECT_THAT(fault(with("camera_model", "OPENCV_FISHEYE")), HasSubstr("camera_model: `OPENCV_FISHEYE` is not read"));
  EXPECT_THAT(fault(with("is_fisheye", true)), HasSubstr("is_fisheye"));
  EXPECT_THAT(fault(with("k4", 0.1)), HasSubstr("k4"));
  EXPECT_THAT(fault(with("depth_unit_scale_factor", 0)), HasSubstr("depth_unit_scale_factor: must be positive"));
  EXPECT_THAT(fault(with("applied_transform", "no")), HasSubstr("applied_transform: is not a matrix"));
  EXPECT_THAT(fault(with_frame("file_path", 3)), HasSubstr("frame 2: file_path: is not a text"));
  EXPECT_THAT(fault(with_frame("file_path", "a\nb")), HasSubstr("frame 2: file_path: holds control characters"));
  EXPECT_THAT(fault(with_frame("transform_matrix", json::array({1, 2}))), HasSubstr("is not a matrix of 3 or 4 rows"));
  EXPECT_THAT(fault(with_frame("transform_matrix", {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 2, 0}})),
              HasSubstr("frame 2: transform_matrix: the matrix is no rotation"));
  json file = tiny();
  file["frames"][0].erase("file_path");
  EXPECT_THAT(fault(file), HasSubstr("frame 1: file_path: is missing"));
  file = tiny();
  file.erase("fl_x");
  EXPECT_THAT(fault(file), HasSubstr("fl_x: is missing, and so is camera_angle_x"));
  file["camera_angle_x"] = 4.0;
  EXPECT_THAT(fault(file), HasSubstr("camera_angle_x: is not an angle in 0..pi"));
}

TEST(SequenceNerfstudio, ReadsPathsOfWindows) {
  const TempFolder temp;
  json file = tiny();
  for (json& frame : file["frames"]) {
    std::string path = frame["file_path"];
    path.replace(path.find('/'), 1, "\\");
    frame["file_path"] = path;
  }
  file["frames"][1]["depth_file_path"] = ".\\depth\\8.png";
  put(temp, file);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.size(), 3U);
  EXPECT_EQ(s.depth(1).cols, 16);
}

TEST(SequenceNerfstudio, FindsImagesWithoutTheirExtension) {
  for (const char* ending : {".png", ".jpg", ".jpeg", ".PNG", ".JPG", ".JPEG"}) {
    const TempFolder temp;
    json file = tiny();
    for (int k = 0; k < 3; ++k) {
      const std::string name = "images/frame_" + std::to_string(k);
      file["frames"][static_cast<std::size_t>(k)]["file_path"] = name;
      temp.put_image(name + ending, cv::Mat3b(12, 16, cv::Vec3b::all(40)));
    }
    temp.put("transforms.json", file.dump());
    EXPECT_EQ(Sequence::open(temp.path()).size(), 3U) << ending;
    std::filesystem::remove(temp / "images/frame_1" + ending);
    EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
                HasSubstr("images/frame_1.png: is missing, and so is that name with .jpg or .jpeg"));
  }
}

TEST(SequenceNerfstudio, ANamedCameraCountsBeforeCamerasOfFrames) {
  const TempFolder temp;
  json file = tiny();
  file["frames"][1]["fl_x"] = 30.0;
  put(temp, file);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("has another camera than"));
  SequenceOptions options;
  options.camera_file = temp.put("c.yaml", "width: 16\nheight: 12\nfx: 33\nfy: 33\ncx: 7.5\ncy: 5.5\n");
  EXPECT_EQ(Sequence::open(temp.path(), options).camera().fx, 33.0);
}

TEST(SequenceNerfstudio, SaysWhatIsMissing) {
  const TempFolder temp;
  put(temp, tiny());
  std::filesystem::remove(temp / "images/8.png");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()).color(1); }), HasSubstr("images/8.png: is missing"));
  for (const char* name : {"images/7.png", "images/9.png"}) std::filesystem::remove(temp / name);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("images/7.png: is missing"));
  SequenceOptions options;
  options.layout = "nerfstudio";
  EXPECT_THAT(error_of([&] { Sequence::open(temp / "images", options); }), HasSubstr("transforms.json: is missing"));
}

}  // namespace
}  // namespace odosplat
