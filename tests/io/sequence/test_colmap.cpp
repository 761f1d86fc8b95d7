// SPDX-License-Identifier: Apache-2.0
// Copyright 2026 The odosplat authors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <string>

#include "odosplat/camera/undistort.hpp"
#include "odosplat/io/sequence/colmap_model.hpp"
#include "odosplat/io/sequence/sequence.hpp"
#include "tests/io/sequence/colmap_writer.hpp"
#include "tests/io/temp_folder.hpp"

namespace odosplat {
namespace {

namespace fs = std::filesystem;
using test::ColmapModel;
using test::error_of;
using test::TempFolder;
using testing::HasSubstr;

SE3 pose(double k) { return SE3::exp((Vector6d() << 0.3 * k, -0.2, 1.0 + k, 0.2 * k, -0.5, 0.1).finished()); }

// Three images of one 16x12 camera, listed out of order, one of them in a subfolder.
ColmapModel tiny_model() {
  ColmapModel model;
  model.cameras = {{7, 4, "OPENCV", 16, 12, {20.0, 21.0, 8.25, 6.5, 0.01, -0.02, 0.003, -0.004}}};
  model.images = {{1, pose(0), 7, "f10.png", 2}, {2, pose(1), 7, "f2.png", 0}, {5, pose(2), 7, "a/f3.png", 1}};
  model.points.points = {{1, 2, 3}, {-0.25F, 0.5F, 4}};
  model.points.colors = {{0, 1, 0.2F}, {1, 0, 0.4F}};
  return model;
}

void put(const TempFolder& temp, const std::string& folder, const ColmapModel& model, bool binary) {
  const std::string ending = binary ? ".bin" : ".txt";
  temp.put(folder + "cameras" + ending, binary ? model.cameras_binary() : model.cameras_text());
  temp.put(folder + "images" + ending, binary ? model.images_binary() : model.images_text());
  temp.put(folder + "points3D" + ending, binary ? model.points_binary() : model.points_text());
}

void put_images(const TempFolder& temp, const std::string& folder, const ColmapModel& model) {
  for (const ColmapModel::Image& image : model.images) {
    temp.put_image(folder + image.name, cv::Mat3b(12, 16, cv::Vec3b::all(static_cast<uchar>(20 * image.id))));
  }
}

void expect_tiny(const std::string& path) {
  SCOPED_TRACE(path);
  const Sequence s = Sequence::open(path);
  EXPECT_EQ(s.layout(), "colmap");
  EXPECT_EQ(s.camera(), (Camera{16, 12, 20.0, 21.0, 7.75, 6.0}));
  EXPECT_EQ(s.camera_file().distortion, (std::vector<double>{0.01, -0.02, 0.003, -0.004}));
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s.truth().size(), 3U);
  EXPECT_EQ(s.fps(), 30.0);
  const int number[] = {2, 1, 0};
  const int id[] = {5, 2, 1};  // a/f3, f2, f10
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(s.time(i), static_cast<double>(i) / 30.0, 1e-12);
    EXPECT_NEAR(s.color(i)(6, 8)[0], 20.0F * static_cast<float>(id[i]) / 255.0F, 1e-6F);
    const SE3 difference = *s.T_world_camera(i) * pose(number[i]);
    EXPECT_LT(difference.log().norm(), 1e-12);
    EXPECT_FALSE(s.has_depth(i));
  }
  ASSERT_TRUE(s.has_sparse_points());
  const PointCloud points = s.sparse_points();
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points.points[1], Eigen::Vector3f(-0.25F, 0.5F, 4));
  EXPECT_LT((points.colors[0] - Eigen::Vector3f(0, 1, 0.2F)).norm(), 1e-6F);
}

TEST(SequenceColmap, ReadsTextAndBinaryWhereverTheModelLies) {
  for (const bool binary : {false, true}) {
    for (const char* folder : {"", "sparse/", "sparse/0/"}) {
      const TempFolder temp;
      put(temp, std::string("seq/") + folder, tiny_model(), binary);
      put_images(temp, "seq/images/", tiny_model());
      expect_tiny(temp / "seq");
    }
  }
}

TEST(SequenceColmap, FindsImagesBesideAndAbove) {
  for (const char* images : {"seq/sparse/0/", "seq/sparse/images/", "seq/images/"}) {
    const TempFolder temp;
    put(temp, "seq/sparse/0/", tiny_model(), true);
    put_images(temp, images, tiny_model());
    expect_tiny(temp / "seq/sparse/0");
  }
  const TempFolder temp;
  put(temp, "seq/sparse/0/", tiny_model(), true);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path() + "/seq"); }), HasSubstr("image a/f3.png: is in none of"));
}

TEST(SequenceColmap, PrefersBinaryAndTheCameraFile) {
  const TempFolder temp;
  ColmapModel other = tiny_model();
  other.cameras[0].parameters[0] = 99.0;
  put(temp, "sparse/0/", other, false);
  put(temp, "sparse/0/", tiny_model(), true);
  put_images(temp, "images/", tiny_model());
  expect_tiny(temp.path());
  temp.put("camera.yaml", "width: 16\nheight: 12\nfx: 30\nfy: 30\ncx: 7.5\ncy: 5.5\nfps: 10\n");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_EQ(s.camera().fx, 30.0);
  EXPECT_NEAR(s.time(2), 0.2, 1e-12);
}

// Projects a point as COLMAP defines it: by its pose and lens model, with pixels counted from the corner. The sequence
// must project it to the same place in the image, half a pixel less in coordinates.
TEST(SequenceColmap, ReprojectsAPointWhereColmapDoes) {
  const ColmapModel model = tiny_model();
  const TempFolder temp;
  put(temp, "", model, true);
  put_images(temp, "", model);
  const Sequence s = Sequence::open(temp.path());
  const Eigen::Vector3d p_world = pose(1).inverse() * Eigen::Vector3d(0.3, -0.2, 1.5);
  const Eigen::Vector3d c = model.images[1].T_camera_world * p_world;
  const std::vector<double>& k = model.cameras[0].parameters;
  const double x = c.x() / c.z();
  const double y = c.y() / c.z();
  const double r2 = x * x + y * y;
  const double radial = k[4] * r2 + k[5] * r2 * r2;
  const double u = k[0] * (x + x * radial + 2.0 * k[6] * x * y + k[7] * (r2 + 2.0 * x * x)) + k[2];
  const double v = k[1] * (y + y * radial + 2.0 * k[7] * x * y + k[6] * (r2 + 2.0 * y * y)) + k[3];
  const Eigen::Vector2d straight = s.camera().project(s.T_world_camera(1)->inverse() * p_world);
  const CameraFile file = s.camera_file();
  const Eigen::Vector2d seen = Undistorter(file.camera, file.distortion).distort(straight.x(), straight.y());
  EXPECT_NEAR(seen.x() + 0.5, u, 1e-9);
  EXPECT_NEAR(seen.y() + 0.5, v, 1e-9);
}

TEST(ColmapCameras, ReadsEveryModelThatItSays) {
  ColmapModel model;
  model.cameras = {{1, 0, "SIMPLE_PINHOLE", 640, 480, {500, 320, 240}},
                   {2, 1, "PINHOLE", 640, 480, {500, 510, 320, 240}},
                   {3, 2, "SIMPLE_RADIAL", 640, 480, {500, 320, 240, 0.1}},
                   {4, 3, "RADIAL", 640, 480, {500, 320, 240, 0.1, 0.2}},
                   {5, 4, "OPENCV", 640, 480, {500, 510, 320, 240, 0.1, 0.2, 0.3, 0.4}},
                   {6, 4, "OPENCV", 640, 480, {500, 510, 320, 240, 0, 0, 0, 0}}};
  using Numbers = std::vector<double>;
  for (const ColmapCameras& cameras : {parse_colmap_cameras_text("c", model.cameras_text()),
                                       parse_colmap_cameras_binary("c", model.cameras_binary())}) {
    ASSERT_EQ(cameras.size(), 6U);
    for (const auto& [id, file] : cameras) {
      const bool two = id == 2 || id >= 5;
      EXPECT_EQ(file.camera, (Camera{640, 480, 500, two ? 510.0 : 500.0, 319.5, 239.5})) << id;
    }
    EXPECT_EQ(cameras.at(1).distortion, Numbers());
    EXPECT_EQ(cameras.at(3).distortion, (Numbers{0.1, 0, 0, 0}));
    EXPECT_EQ(cameras.at(4).distortion, (Numbers{0.1, 0.2, 0, 0}));
    EXPECT_EQ(cameras.at(5).distortion, (Numbers{0.1, 0.2, 0.3, 0.4}));
    EXPECT_EQ(cameras.at(6).distortion, Numbers());
  }
}

TEST(ColmapCameras, RefusesOtherModelsByName) {
  ColmapModel model = tiny_model();
  model.cameras[0].model = 5;
  model.cameras[0].name = "OPENCV_FISHEYE";
  EXPECT_THAT(error_of([&] { parse_colmap_cameras_text("c.txt", model.cameras_text()); }),
              HasSubstr("c.txt: line 2: camera model `OPENCV_FISHEYE` is not read"));
  EXPECT_THAT(error_of([&] { parse_colmap_cameras_binary("c.bin", model.cameras_binary()); }),
              HasSubstr("c.bin: camera 1 of 1: camera model `OPENCV_FISHEYE` is not read"));
  model.cameras[0].model = 77;
  EXPECT_THAT(error_of([&] { parse_colmap_cameras_binary("c.bin", model.cameras_binary()); }), HasSubstr("number 77"));
}

TEST(ColmapCameras, NamesEveryFault) {
  const auto fault = [](const std::string& text) {
    return error_of([&] { parse_colmap_cameras_text("c.txt", text); });
  };
  EXPECT_THAT(fault("# none\n"), HasSubstr("c.txt: lists no camera"));
  EXPECT_THAT(fault("x PINHOLE 4 4 1 1 2 2\n"), HasSubstr("line 1: `x` is not the number of a camera"));
  EXPECT_THAT(fault("1 PINHOLE 4 4 1 1 2\n"), HasSubstr("PINHOLE has 4 parameters, here are 3"));
  EXPECT_THAT(fault("1 PINHOLE 4 4.5 1 1 2 2\n"), HasSubstr("size is not in 1..32768"));
  EXPECT_THAT(fault("1 PINHOLE 4 99999 1 1 2 2\n"), HasSubstr("size is not in 1..32768"));
  EXPECT_THAT(fault("1 PINHOLE 4 4 0 1 2 2\n"), HasSubstr("fx: must be positive"));
  EXPECT_THAT(fault("1 PINHOLE 4 4 nan 1 2 2\n"), HasSubstr("`nan` is not a number"));
  EXPECT_THAT(fault("1 PINHOLE 4 4 1 1 2 2\n1 PINHOLE 4 4 1 1 2 2\n"), HasSubstr("line 2: camera 1 is listed twice"));
  ColmapModel model = tiny_model();
  model.cameras[0].parameters[5] = std::numeric_limits<double>::infinity();
  EXPECT_THAT(error_of([&] { parse_colmap_cameras_binary("c", model.cameras_binary()); }), HasSubstr("not finite"));
}

TEST(ColmapImages, NamesEveryFault) {
  const auto fault = [](const std::string& text) { return error_of([&] { parse_colmap_images_text("i.txt", text); }); };
  const std::string good = "1 1 0 0 0 0 0 0 7 a.png\n\n";
  EXPECT_EQ(parse_colmap_images_text("i.txt", good).size(), 1U);
  EXPECT_EQ(parse_colmap_images_text("i.txt", "1 1 0 0 0 0 0 0 7 a b.png").front().name, "a b.png");
  EXPECT_THAT(fault("\n"), HasSubstr("i.txt: lists no image"));
  EXPECT_THAT(fault("1 1 0 0 0 0 0 0 7\n\n"), HasSubstr("line 1: has no name"));
  EXPECT_THAT(fault("1 0 0 0 0 0 0 0 7 a.png\n\n"), HasSubstr("line 1: the quaternion has length 0, must be near 1"));
  EXPECT_THAT(fault("1 1 0 0 0 0 0 x 7 a.png\n\n"), HasSubstr("`x` is not a number"));
  EXPECT_THAT(fault("1 1 0 0 0 0 0 0 -7 a.png\n\n"), HasSubstr("`-7` is not the number of a camera"));
  EXPECT_THAT(fault(good + good), HasSubstr("image a.png: is listed twice"));
  // Without the empty lines the second image would be read as pixels, whatever the number of words in its name.
  EXPECT_THAT(fault("1 1 0 0 0 0 0 0 7 a.png\n2 1 0 0 0 0 0 0 7 b 0 1.png\n"),
              HasSubstr("line 2: expected the pixels"));
  EXPECT_THAT(fault("1 1 0 0 0 0 0 0 7 a.png\n1.5 2.5 0.5\n"), HasSubstr("line 2: expected the pixels"));
  EXPECT_THAT(fault("1 1 0 0 0 0 0 0 7 a.png\n2 1 0 0 0 0 0 0 7 b.png\n"), HasSubstr("line 2: expected the pixels"));
}

TEST(ColmapImages, APoseThatIsNotFiniteIsNone) {
  const auto images = parse_colmap_images_text(
      "i.txt", "1 nan nan nan nan 0 0 0 7 a.png\n\n2 1 0 0 0 -inf 0 0 7 b.png\n\n3 1 0 0 0 0 0 0 7 c  d e.png\n\n");
  ASSERT_EQ(images.size(), 3U);
  EXPECT_FALSE(images[0].T_world_camera);
  EXPECT_FALSE(images[1].T_world_camera);
  EXPECT_TRUE(images[2].T_world_camera);
  EXPECT_EQ(images[2].name, "c  d e.png");
  ColmapModel model = tiny_model();
  model.images[1].T_camera_world = SE3(Eigen::Quaterniond::Identity(), {0, std::nan(""), 0});
  const TempFolder temp;
  put(temp, "", model, true);
  put_images(temp, "", model);
  const Sequence s = Sequence::open(temp.path());
  EXPECT_TRUE(s.T_world_camera(0));
  EXPECT_FALSE(s.T_world_camera(1));  // f2
  EXPECT_EQ(s.truth().size(), 2U);
}

TEST(ColmapText, ByteOrderMarksArePassedOver) {
  const std::string mark = "\xEF\xBB\xBF";
  EXPECT_EQ(parse_colmap_cameras_text("c", mark + tiny_model().cameras_text()).size(), 1U);
  EXPECT_EQ(parse_colmap_images_text("i", mark + tiny_model().images_text()).size(), 3U);
  EXPECT_EQ(parse_colmap_points_text("p", mark + tiny_model().points_text()).size(), 2U);
  EXPECT_EQ(parse_colmap_images_text("i", mark + "1 1 0 0 0 0 0 0 7 a.png\n\n").size(), 1U);
}

TEST(ColmapBinary, NeverTrustsWhatItPromises) {
  const ColmapModel model = tiny_model();
  const auto cut = [](const auto& parse, const std::string& whole) {
    for (std::size_t n = 0; n < whole.size(); ++n) {
      EXPECT_THAT(error_of([&] { parse("m.bin", whole.substr(0, n)); }), HasSubstr("m.bin: ")) << n;
    }
  };
  cut(parse_colmap_cameras_binary, model.cameras_binary());
  cut(parse_colmap_images_binary, model.images_binary());
  cut(parse_colmap_points_binary, model.points_binary());
  std::string images = model.images_binary();
  images.replace(0, 8, 8, '\x7f');
  EXPECT_THAT(error_of([&] { parse_colmap_images_binary("m.bin", images); }),
              HasSubstr("m.bin: image 4 of 9187201950435737471: the file ends in the middle of it"));
  EXPECT_THAT(error_of([&] { parse_colmap_images_binary("m.bin", std::string(8, '\0')); }), HasSubstr("no image"));
  ColmapModel lines = model;
  lines.images[0].name = "two\nlines.png";
  EXPECT_THAT(error_of([&] { parse_colmap_images_binary("m.bin", lines.images_binary()); }), HasSubstr("control"));
}

TEST(ColmapPoints, NamesEveryFault) {
  const auto fault = [](const std::string& text) { return error_of([&] { parse_colmap_points_text("p.txt", text); }); };
  EXPECT_EQ(parse_colmap_points_text("p.txt", "# none\n").size(), 0U);
  EXPECT_EQ(parse_colmap_points_text("p.txt", "1 1 2 3 0 0 255 0.1\n").size(), 1U);
  EXPECT_THAT(fault("1 1 2\n"), HasSubstr("line 1: `` is not a number"));
  EXPECT_THAT(fault("1 1 2 1e30 0 0 0 1\n"), HasSubstr("line 1: its place is out of range"));
  EXPECT_THAT(fault("1 1 2 3 0 0 256 1\n"), HasSubstr("line 1: its colour is not in 0..255"));
}

TEST(SequenceColmap, RefusesSeveralCamerasUnlessOneIsGiven) {
  const TempFolder temp;
  ColmapModel model = tiny_model();
  model.cameras.push_back(model.cameras[0]);
  model.cameras[1].id = 8;
  model.images[0].camera = 8;
  put(temp, "", model, false);
  put_images(temp, "", model);
  expect_tiny(temp.path());  // two cameras with the same parameters count as one
  model.cameras[1].parameters[0] = 20.5;
  put(temp, "", model, false);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }),
              HasSubstr("images.txt: image f10.png: has another camera than image a/f3.png"));
  model.cameras[1].parameters[0] = 20.125;
  put(temp, "", model, false);
  EXPECT_EQ(Sequence::open(temp.path()).camera().fx, 20.0);  // the median
  model.cameras[1].parameters[0] = 20.5;
  put(temp, "", model, false);
  SequenceOptions options;
  options.camera_file = temp.put("c.yaml", "width: 16\nheight: 12\nfx: 30\nfy: 30\ncx: 7.5\ncy: 5.5\n");
  EXPECT_EQ(Sequence::open(temp.path(), options).camera().fx, 30.0);
  model.images[0].camera = 9;
  put(temp, "", model, false);
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()); }), HasSubstr("its camera 9 is not among the cameras"));
}

TEST(SequenceColmap, SaysWhatIsMissing) {
  const TempFolder temp;
  put(temp, "", tiny_model(), true);
  put_images(temp, "", tiny_model());
  temp.put("points3D.bin", std::string(8, '\0'));
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()).sparse_points(); }),
              HasSubstr("points3D.bin: holds no point"));
  fs::remove(temp / "points3D.bin");
  const Sequence s = Sequence::open(temp.path());
  EXPECT_FALSE(s.has_sparse_points());
  EXPECT_THAT(error_of([&] { s.sparse_points(); }), HasSubstr("has no sparse points"));
  fs::remove(temp / "f2.png");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path()).color(1); }), HasSubstr("f2.png: is missing"));
  SequenceOptions options;
  options.layout = "colmap";
  fs::remove(temp / "cameras.bin");
  EXPECT_THAT(error_of([&] { Sequence::open(temp.path(), options); }), HasSubstr("holds no COLMAP model"));
}

TEST(SequenceColmap, ReflectsThePointsWithThePoses) {
  const TempFolder temp;
  put(temp, "", tiny_model(), true);
  put_images(temp, "", tiny_model());
  temp.put("camera.yaml", "width: 16\nheight: 12\nfx: 30\nfy: -30\ncx: 7.5\ncy: 5.5\n");
  const Sequence s = Sequence::open(temp.path());
  const Eigen::Vector3d p_stored(1, 2, 3);
  const Eigen::Vector3d stored = pose(2) * p_stored;  // in the camera frame
  const Eigen::Vector3d p = s.sparse_points().points[0].cast<double>();
  const Eigen::Vector3d ours = s.T_world_camera(0)->inverse() * p;
  EXPECT_LT((ours - Eigen::Vector3d(stored.x(), -stored.y(), stored.z())).norm(), 1e-6);
}

}  // namespace
}  // namespace odosplat
